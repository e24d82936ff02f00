"""Shape functions, one file each."""
