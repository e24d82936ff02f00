"""A Slurm array of the cases of a study that are still to do."""

import re
import shlex
from collections.abc import Sequence
from pathlib import Path

from cramp_cli.output.atomic import write_text
from cramp_cli.output.exits import STOPPED
from cramp_cli.study.cases import Case
from cramp_cli.study.one_case import Sweep

SCRIPT = """\
#!/bin/bash
# Written by `cramp sweep run --backend slurm`. Add account, partition and time limit here or as
# options of sbatch.
#SBATCH --job-name={title}
#SBATCH --array=0-{last}{limit}
#SBATCH --cpus-per-task={threads}
#SBATCH --output="{folder}/slurm-%A_%a.out"
#SBATCH --open-mode=append
#SBATCH --requeue
#SBATCH --signal=USR1@120
cd {here} || exit 4
case=$(sed -n "$((SLURM_ARRAY_TASK_ID + 1))p" {todo})
srun {python} -m cramp_cli sweep run {study} -o {folder_word} -t {threads} --only "$case"
code=$?
# {stopped}: stopped early with a checkpoint; the queue takes it up again.
if [ "$code" -eq {stopped} ]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_${{SLURM_ARRAY_TASK_ID}}"
fi
exit "$code"
"""


def write_slurm(
    sweep: Sweep, study: Path, cases: Sequence[Case], jobs: int | None, python: str
) -> Path:
    """Write the script and the list of cases it runs; return the script's path.

    jobs: most cases at a time; None leaves it to the queue
    """
    folder = sweep.folder.path.absolute()
    (folder / "runs").mkdir(parents=True, exist_ok=True)
    write_text(folder / "todo.txt", "".join(f"{case.name}\n" for case in cases))
    text = SCRIPT.format(
        title=re.sub(r"\W", "_", study.stem),
        last=len(cases) - 1,
        limit=f"%{jobs}" if jobs else "",
        threads=sweep.threads,
        folder=folder,
        folder_word=shlex.quote(str(folder)),
        todo=shlex.quote(str(folder / "todo.txt")),
        here=shlex.quote(str(Path.cwd())),
        python=shlex.quote(python),
        study=shlex.quote(str(study)),
        stopped=STOPPED,
    )
    write_text(folder / "sweep.slurm", text)
    return folder / "sweep.slurm"
