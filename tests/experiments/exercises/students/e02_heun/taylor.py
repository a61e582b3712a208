from numpy import float64

EXERCISE = 2


def step(y, v, dt, spring):
    def pull(height, speed):
        return (
            float64(spring.stiffness) / spring.mass * (-height - spring.rest_length)
            - spring.gravity
            - spring.damping / spring.mass * speed
        )

    a = pull(y, v)
    v_after = v + a * dt
    y_after = y + v * dt
    b = pull(y_after, v_after)
    # the mean of v and v + a dt is v + a dt / 2
    return y + v * dt + a * dt**2 / 2, v + dt * (a + b) / 2
