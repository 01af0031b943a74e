# Makes motion.svg, the picture on top of the README, from numbers of the command; at the repository's top:
#
#     jourdain simulate models/squeezer.toml --duration 0.12 --step 2e-6 --every 4 --output squeezer.csv
#     python3 .readme/motion.py squeezer.csv > .readme/motion.svg
#
# Shows the last full turn of the crank, slower. The joints of the picture are the model's, one group in the other, and
# turn by the angles of the CSV; what a body looks like beside its points is chosen. Only the standard library is used.
import csv
import math
import sys

FRAMES = 96  # of a turn
SECONDS = 4.0  # that a turn takes in the picture
SCALE = 3250.0  # pixels per m
WIDTH, HEIGHT = 760, 390
ORIGIN = (265.0, 262.0)  # of the model's axes, in the picture
LEFT, RIGHT = 420.0, 690.0  # of the plots

# Points of the model, m.
A, B, C = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
K2_PIN, E_ON_K2 = (0.007, 0), (-0.028, 0)
D_ON_K3, E_ON_K3 = (0.02, -0.018), (0, -0.035)
K4_PIN, E_ON_K4 = (0.04, 0), (0, -0.02)
K6_PIN, E_ON_K6 = (0, -0.04), (0.02, 0)
MASS_K2, MASS_K3, MASS_K5, MASS_K7 = (-0.0115, 0), (0.01043, -0.01874), (0.02308, 0.00916), (-0.00449, -0.01228)

BLUE, ORANGE, GREEN, VIOLET, GREY = "#4c8dd6", "#e08a2e", "#3fa66b", "#9a78d0", "#8a929c"


def last_turn(path):
    """Rows of the CSV at FRAMES + 1 equal times over the crank's last full turn."""
    with open(path, newline="") as file:
        rows = [{name: float(text) for name, text in row.items()} for row in csv.DictReader(file)]
    end = rows[-1]
    begin = at_value(rows, "beta", end["beta"] - 2 * math.pi)
    times = [begin["time"] + (end["time"] - begin["time"]) * k / FRAMES for k in range(FRAMES + 1)]
    return [at_value(rows, "time", time) for time in times]


def at_value(rows, name, value):
    """A row between those of the CSV; `name` is a column that grows."""
    after = next((k for k, row in enumerate(rows) if row[name] >= value), len(rows) - 1)
    if after == 0:
        raise SystemExit(f"{name} does not reach {value}: simulate for longer")
    low, high = rows[after - 1], rows[after]
    part = (value - low[name]) / (high[name] - low[name])
    return {key: low[key] + part * (high[key] - low[key]) for key in low}


def number(value, digits=2):
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def pixel(point):
    """In a body's axes, pixels; the picture's y axis points down."""
    return number(point[0] * SCALE), number(-point[1] * SCALE)


def path(points, closed=False):
    return "M" + "L".join(" ".join(pixel(point)) for point in points) + ("Z" if closed else "")


def animated(attribute, values):
    return (f'<animate attributeName="{attribute}" dur="{number(SECONDS)}s" repeatCount="indefinite" '
            f'values="{";".join(values)}"/>')


def turning(turn, name, place, content):
    """A body's group: at `place` of its parent, turned by the joint's angle."""
    first = turn[0][name]
    whole = round(first / (2 * math.pi)) * 2 * math.pi  # as few digits as can be
    values = ";".join(number(-math.degrees(row[name] - whole)) for row in turn)
    x, y = pixel(place)
    return (f'<g transform="translate({x} {y})"><g>'
            f'<animateTransform attributeName="transform" type="rotate" dur="{number(SECONDS)}s" '
            f'repeatCount="indefinite" values="{values}"/>{content}</g></g>')


def bar(points, color, width=8):
    return f'<path d="{path(points)}" stroke="{color}" stroke-width="{width}"/>'


def plate(points, color):
    return f'<path d="{path(points, True)}" fill="{color}" fill-opacity=".55" stroke="{color}" stroke-width="6"/>'


def pin(point, radius=2.8):
    x, y = pixel(point)
    return f'<circle cx="{x}" cy="{y}" r="{number(radius)}" fill="#fff" stroke="#3b434d" stroke-width="1.8"/>'


def ground(point):
    x, y = (float(text) for text in pixel(point))
    return (f'<path d="M{number(x)} {number(y)}l-8 13h16z" fill="{GREY}" fill-opacity=".35" stroke="{GREY}" '
            f'stroke-width="1.6"/><path d="M{number(x - 13)} {number(y + 13)}h26" stroke="{GREY}" stroke-width="2.4"/>')


def mass(point):
    """The sign of a centre of mass."""
    x, y = (float(text) for text in pixel(point))
    r = 4
    return (f'<circle cx="{number(x)}" cy="{number(y)}" r="{r}" fill="#fff" stroke="#3b434d" stroke-width="1.3"/>'
            f'<path d="M{number(x)} {number(y)}v-{r}a{r} {r} 0 0 1 {r} {r}zv{r}a{r} {r} 0 0 1-{r}-{r}z" fill="#3b434d" '
            f'stroke="none"/>')


def turned(point, angle):
    c, s = math.cos(angle), math.sin(angle)
    return (c * point[0] - s * point[1], s * point[0] + c * point[1])


def plus(a, b):
    return (a[0] + b[0], a[1] + b[1])


def spring(start, end, coils=9, width=0.0021):
    """A zigzag from point to point."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    along, across = (dx / length, dy / length), (-dy / length, dx / length)
    points = [start]
    lead = 0.12
    for k in range(2 * coils + 1):
        s = (lead + (1 - 2 * lead) * k / (2 * coils)) * length
        side = 0 if k in (0, 2 * coils) else width * (1 if k % 2 else -1)
        points.append((start[0] + s * along[0] + side * across[0], start[1] + s * along[1] + side * across[1]))
    return path(points + [end])


def plot(turn, top, bottom, signals, unit, title, ticks):
    """Signals over the turn, a dot on each running along."""
    values = [unit(row[name]) for name, _, _ in signals for row in turn]
    low, high = min(*values, *ticks), max(*values, *ticks)

    def height(value):
        return number(bottom - (bottom - top) * (unit(value) - low) / (high - low), 1)

    def across(k):
        return number(LEFT + (RIGHT - LEFT) * k / FRAMES, 1)

    parts = [f'<text x="{number(LEFT)}" y="{number(top - 12)}" fill="{GREY}">{title}</text>']
    for tick in ticks:
        y = number(bottom - (bottom - top) * (tick - low) / (high - low), 1)
        parts.append(f'<path d="M{number(LEFT)} {y}H{number(RIGHT)}" stroke="{GREY}" stroke-opacity=".35"/><text '
                     f'x="{number(LEFT - 6)}" y="{y}" dy=".35em" text-anchor="end" fill="{GREY}">{tick}</text>')
    for name, label, color in signals:
        heights = [height(row[name]) for row in turn]
        curve = "L".join(f"{across(k)} {y}" for k, y in enumerate(heights))
        parts.append(f'<path d="M{curve}" fill="none" stroke="{color}" stroke-width="2"/><text '
                     f'x="{number(RIGHT + 8)}" y="{heights[-1]}" dy=".35em" fill="{color}">{label}</text>'
                     f'<circle r="4" fill="{color}">{animated("cx", [number(LEFT), number(RIGHT)])}'
                     f'{animated("cy", heights)}</circle>')
    return f'<g font-family="sans-serif" font-size="13">{"".join(parts)}</g>'


def time_axis(turn, bottom):
    """Names the length of the turn, and a line that runs along."""
    lasts = 1e3 * (turn[-1]["time"] - turn[0]["time"])
    y = number(bottom + 24)
    return (f'<g font-family="sans-serif" font-size="13" fill="{GREY}"><text x="{number(LEFT)}" y="{y}">0</text>'
            f'<text x="{number(RIGHT)}" y="{y}" text-anchor="end">{lasts:.2f} ms</text></g>'
            f'<path d="M0 34V214M0 262V{bottom}" stroke="{GREY}" stroke-dasharray="3 3"><animateTransform '
            f'attributeName="transform" type="translate" dur="{number(SECONDS)}s" repeatCount="indefinite" '
            f'values="{number(LEFT)};{number(RIGHT)}"/></path>')


def main():
    turn = last_turn(sys.argv[1])
    d = [plus(B, turned(D_ON_K3, row["gamma"])) for row in turn]
    e = [plus(B, turned(E_ON_K3, row["gamma"])) for row in turn]
    crank = [turned(K2_PIN, row["beta"]) for row in turn]
    k4 = [plus(A, turned(K4_PIN, row["delta"])) for row in turn]
    k6 = [plus(A, turned(K6_PIN, row["epsilon"])) for row in turn]
    gap = max(math.dist(point, (row["common_pin.position[0]"], row["common_pin.position[1]"]))
              for point, row in zip(e, turn))
    if gap > 1e-5:
        raise SystemExit(f"the points of this script are not the model's: pin E is off by {gap} m")

    coupler = [plus(p, turned(MASS_K2, row["beta"] + row["Theta"])) for p, row in zip(crank, turn)]
    traces = "".join(f'<path d="{path(points)}" stroke="{color}" stroke-width="1.4" stroke-opacity=".6"/>'
                     for points, color in ((e, ORANGE), (d, ORANGE), (coupler, BLUE), (crank, BLUE), (k4, GREEN),
                                           (k6, VIOLET)))
    body = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}">',
        "<title>Andrews' squeezing mechanism, one turn of its crank</title>",
        f'<g transform="translate({number(ORIGIN[0])} {number(ORIGIN[1])})" fill="none" stroke-linecap="round" '
        'stroke-linejoin="round">',
        ground(A), ground(B), ground((0, 0)), ground(C), traces,
        f'<path stroke="{GREY}" stroke-width="2.2">{animated("d", [spring(C, point) for point in d])}</path>',
        turning(turn, "delta", A, plate([(0, 0), K4_PIN, (0.0231, 0.0165)], GREEN) + mass(MASS_K5)
                + turning(turn, "Phi", K4_PIN, bar([(0, 0), E_ON_K4], GREEN) + pin((0, 0)))),
        turning(turn, "epsilon", A, plate([(0, 0), K6_PIN, (-0.0095, -0.0225)], VIOLET) + mass(MASS_K7)
                + turning(turn, "Omega", K6_PIN, bar([(0, 0), E_ON_K6], VIOLET) + pin((0, 0)))),
        turning(turn, "gamma", B, plate([(0, 0), D_ON_K3, E_ON_K3], ORANGE) + mass(MASS_K3) + pin(D_ON_K3)),
        turning(turn, "beta", (0, 0), bar([(0, 0), K2_PIN], BLUE, 11)
                + turning(turn, "Theta", K2_PIN, bar([(0, 0), E_ON_K2], BLUE) + pin((0, 0)) + pin(E_ON_K2, 3.6)
                          + mass(MASS_K2))),
        pin(A, 3.4), pin(B, 3.4), pin((0, 0), 3.4), pin(C, 3.4),
        "</g>",
        plot(turn, 34, 214, [("gamma", "γ", ORANGE), ("Phi", "Φ", GREEN), ("epsilon", "ε", VIOLET)], math.degrees,
             "angles, degrees", (0, 30, 60)),
        plot(turn, 262, 352, [("beta_velocity", "", BLUE)], float, "speed of the crank, rad/s", (1600, 2000)),
        time_axis(turn, 352),
        "</svg>",
    ]
    print("\n".join(body))


main()
