def predictor(fun, y, t, h):
    return y + h * fun(t, y)


def step(fun, t, y, h):
    guess = predictor(fun, y, t, h)
    corrected = y + h * fun(t + h, guess)
    return (guess + corrected) / 2
