A = [[0, 0, 0], [0.5, 0, 0], [-1, 2, 0]]
B = [1 / 6, 4 / 6, 1 / 6]
C = [0, 0.5, 1]


def step(f, y, t, h):
    k = []
    for row, c in zip(A, C):
        k.append(f(y + h * sum(a * kj for a, kj in zip(row, k)), t + c * h))
    return y + h * sum(b * kj for b, kj in zip(B, k))
