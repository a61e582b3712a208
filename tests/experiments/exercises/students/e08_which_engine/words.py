EXERCISE = 8
SEED = "example"
names = "rk4 kick_drift drift_kick heun velocity_verlet".split
