EXERCISE = 2


def step(y, v, dt, spring):
    def acceleration(height, speed):
        pull = spring.stiffness * (-height - spring.rest_length)
        return (pull - spring.damping * speed) / spring.mass - spring.gravity

    first = acceleration(y, v)
    guess_y = y + dt * v
    guess_v = v + dt * first
    second = acceleration(guess_y, guess_v)
    return guess_y, v + dt * 0.5 * (first + second)
