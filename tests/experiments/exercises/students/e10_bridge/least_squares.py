import numpy as np

EXERCISE = 10


def heaviest(bridge):
    x = bridge.joints[:, 0] + 1j * bridge.joints[:, 1]
    rows = []
    for joint in range(len(x)):
        row = []
        for a, b in bridge.members:
            unit = (x[b] - x[a]) / abs(x[b] - x[a])
            row.append(unit if joint == a else -unit if joint == b else 0)
        row += [1.0 * (joint == bridge.pinned), 1j * (joint == bridge.pinned), 1j * (joint == bridge.roller)]
        rows.append(row)
    rows = np.array(rows)
    A = np.concatenate([rows.real, rows.imag])
    b = np.concatenate([np.zeros(len(x)), np.multiply(bridge.masses, bridge.gravity)])
    answer, *_ = np.linalg.lstsq(A, b, rcond=None)
    answer = answer[:-3]
    low, high = answer.argmin(), answer.argmax()
    best = low if -answer[low] > answer[high] else high
    return np.int64(best), answer[best]


def largest_dt(bridge):
    # the forces when one joint is moved a little, by differences
    free = [
        (j, a) for j in range(len(bridge.joints)) for a in (0, 1) if j != bridge.pinned and (j, a) != (bridge.roller, 1)
    ]
    rest = [np.linalg.norm(bridge.joints[b] - bridge.joints[a]) for a, b in bridge.members]

    def acceleration(joints):
        f = np.zeros_like(joints)
        for (a, b), k, l in zip(bridge.members, bridge.stiffness, rest):
            d = joints[b] - joints[a]
            t = k * (np.linalg.norm(d) - l) * d / np.linalg.norm(d)
            f[a] += t
            f[b] -= t
        return np.array([f[j, a] / bridge.masses[j] for j, a in free])

    h = 1e-5
    jacobian = []
    for j, a in free:
        plus, minus = bridge.joints.copy(), bridge.joints.copy()
        plus[j, a] += h
        minus[j, a] -= h
        jacobian.append((acceleration(plus) - acceleration(minus)) / (2 * h))
    return 2 / np.sqrt(-np.linalg.eigvals(np.array(jacobian)).real.min())
