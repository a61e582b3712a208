"""Jolt: soft bodies whose edges are springs, by its port to WebAssembly under Node."""
