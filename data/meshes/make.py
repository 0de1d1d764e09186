"""Makes the meshes: a cloth of masses and springs that falls on a ball, ten frames. Prints nothing."""
import itertools
import math
import pathlib

FOLDER = pathlib.Path(__file__).parent
SIZE, FRAMES, STEPS, DT = 11, 10, 60, 0.0015  # vertices along a side, frames, steps of a frame, seconds


def write(name, vertices, faces):
    lines = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in vertices]
    lines += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    (FOLDER / name).write_text("\n".join(lines) + "\n")


def ball(rings=8, sides=12):
    vertices = [(0, 0, 1)]
    for ring in range(1, rings):
        polar = math.pi * ring / rings
        for side in range(sides):
            turn = 2 * math.pi * (side + 0.5 * ring) / sides
            vertices.append((math.sin(polar) * math.cos(turn), math.sin(polar) * math.sin(turn), math.cos(polar)))
    vertices.append((0, 0, -1))
    at = lambda ring, side: 1 + (ring - 1) * sides + side % sides
    faces = [(0, at(1, side), at(1, side + 1)) for side in range(sides)]
    for ring, side in itertools.product(range(1, rings - 1), range(sides)):
        faces += [(at(ring, side), at(ring + 1, side), at(ring, side + 1)),
                  (at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1))]
    return vertices, faces + [(len(vertices) - 1, at(rings - 1, side + 1), at(rings - 1, side)) for side in range(sides)]


def cloth_frames():
    place = [[0.3 * (i - SIZE // 2), 0.3 * (j - SIZE // 2), 1.25 + 0.05 * math.sin(1.7 * i + j)]
             for i in range(SIZE) for j in range(SIZE)]
    speed = [[0.0, 0.0, -1.0] for _ in place]
    at = lambda i, j: SIZE * i + j
    springs = [(at(i, j), at(k, l)) for i in range(SIZE) for j in range(SIZE)
               for k, l in ((i + 1, j), (i, j + 1), (i + 1, j + 1), (i + 1, j - 1), (i + 2, j), (i, j + 2))
               if k < SIZE and 0 <= l < SIZE]
    rests = [math.dist(place[a], place[b]) for a, b in springs]
    for _ in range(FRAMES):
        yield [tuple(point) for point in place]
        for _ in range(STEPS):
            forces = [[-0.5 * v for v in velocity] for velocity in speed]
            for force in forces:
                force[2] -= 9.81
            for (a, b), rest in zip(springs, rests):
                length = math.dist(place[a], place[b])
                for axis in range(3):
                    pull = 2000 * (length - rest) * (place[b][axis] - place[a][axis]) / length
                    forces[a][axis] += pull
                    forces[b][axis] -= pull
            for k, point in enumerate(place):
                away = math.hypot(*point)
                for axis in range(3):
                    push = 5000 * max(0, 0.97 - away) * point[axis] / away  # the ball is soft, so the meshes meet
                    speed[k][axis] += DT * (forces[k][axis] + push)
                    point[axis] += DT * speed[k][axis]


faces_of_cloth = [face for i in range(SIZE - 1) for j in range(SIZE - 1) for k in [SIZE * i + j]
                  for face in ((k, k + SIZE, k + 1), (k + 1, k + SIZE, k + SIZE + 1))]
for frame, vertices in enumerate(cloth_frames()):
    write(f"cloth-{frame}.obj", vertices, faces_of_cloth)
write("ball.obj", *ball())
