EXERCISE = 8
SEED = "example"


def names():
    answers = []
    answers.append("rk4")
    answers.append("kick_drift")
    answers.append("drift_kick")
    answers.append("heun")
    answers.append("velocity_verlet")
    return answers
