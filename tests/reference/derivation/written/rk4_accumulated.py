def step(deriv, state, time, h):
    total = 0
    k = 0 * state
    for part, weight in ((0, 1), (0.5, 2), (0.5, 2), (1, 1)):
        k = deriv(time + part * h, state + part * h * k)
        total = total + weight * k
    return state + h * total / 6
