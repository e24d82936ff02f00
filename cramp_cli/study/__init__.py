"""What is done with runs: times, pictures, sweeps, comparisons."""
