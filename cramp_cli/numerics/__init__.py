"""Compiled kernels, tensors and dispatch: knows no physics."""
