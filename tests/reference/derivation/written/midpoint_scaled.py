def step(rhs, u, t, tau):
    k1 = tau * rhs(u, t)
    k2 = tau * rhs(u + 0.5 * k1, t + 0.5 * tau)
    return u + k2
