EXERCISE = 3


def forces(x, v, string):
    result = []
    for i in range(len(x)):
        fx = -string.drag * v[i][0]
        fy = -string.drag * v[i][1] - string.masses[i] * string.gravity
        hang = string.anchor if i == 0 else x[i - 1]
        ends = [(hang, i)]
        if i < len(x) - 1:
            ends.append((x[i + 1], i + 1))
        for end, j in ends:
            dx, dy = end[0] - x[i][0], end[1] - x[i][1]
            length = (dx**2 + dy**2) ** 0.5
            fx += string.stiffness[j] * (length - string.rest_lengths[j]) * dx / length
            fy += string.stiffness[j] * (length - string.rest_lengths[j]) * dy / length
        result.append((fx, fy))
    return result
