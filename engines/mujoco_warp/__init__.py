"""MuJoCo Warp: MuJoCo's step in kernels of Warp, here on the processor."""
