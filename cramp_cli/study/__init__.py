"""What is done beside a run: pictures, reports, and many runs from one deck."""
