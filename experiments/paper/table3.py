"""Table 3: detecting self-collision.

Quadratic tests all pairs one by one. The searches split the node with more beads; their hierarchies are built beforehand. Sets
are those of bead centres, and each pair of centres lies in exactly one of their pairs. Families are separating families as the
paper defines them (S1, S2), for beads that touch their neighbours. More of the paper's counts fit sets than families. Edges
include those to the infinite vertex.
"""

import kds.timing
from common import span
from paper_table import PaperTable
from scipy.spatial import ConvexHull
from subjects import planar, subject


def diagram_edges(points):
    """Returns the number of edges of the centres' diagram. Every bead of the hull has an edge to the infinite vertex."""
    if points.shape[1] == 2:
        return 3 * len(points) - 3  # a triangulation of the sphere with one more vertex
    return len(kds.power_diagram(points, 1)[0]) + len(ConvexHull(points).vertices)


def self_collision(number, text):
    """Measures table 3 or 4 and prints it."""
    table = PaperTable(number, text, times=["quadratic_us", "wrapped_us", "layered_us"],
                       ratios={"quadratic_per_wrapped": ("quadratic_us", "wrapped_us"),
                               "layered_per_wrapped": ("layered_us", "wrapped_us")},
                       counts=["wrapped_pairs", "layered_pairs", "edges", "wrapped_family", "layered_family"])
    for row in table.rows:
        points, radius = subject(row, table.data)
        points = planar(points)
        found = kds.timing.searches(points, apart=1, rounds=table.rounds)
        touching = kds.timing.searches(points, radius, apart=2, rounds=0)
        collisions = touching["collisions"]
        table.measured(row, quadratic_us=found["quadratic"], wrapped_us=found["wrapped"], layered_us=found["layered"],
                       wrapped_pairs=found["wrapped_pairs"], layered_pairs=found["layered_pairs"], edges=diagram_edges(points),
                       wrapped_family=touching["wrapped_pairs"], layered_family=touching["layered_pairs"],
                       note=f"{collisions} pairs of touching beads collide, and families leave them out" if collisions else None)
    table.print_rows()
    smaller, quadratic = table["wrapped_pairs"] < table["edges"], table["quadratic_per_wrapped"]
    table.claim("sets-smaller", "Separating sets are smaller than the diagram's edges", smaller.all(),
                f"{smaller.sum()} of {len(smaller)} rows")
    table.claim("faster-than-all", "The hierarchy is faster than all pairs", quadratic.min() > 1,
                f"all pairs take {span(quadratic)} times as long")
    return table


if __name__ == "__main__":
    table = self_collision(3, __doc__)
    large = table.where(lambda row: row["beads"] in (1380, 1089))  # the two large proteins
    slower, others = table["layered_per_wrapped"][large], table["layered_per_wrapped"][~large]
    table.claim("layered-slower", "On large proteins the layered hierarchy is slower", slower.min() > 1, f"{span(slower)} times")
    table.claim("layered-as-fast", "On the other models it is as fast, within 15%", 1 / 1.15 < others.min() <= others.max() < 1.15,
                f"{span(others)} times")
    for name, model, grows in (("static-falls", "static helix", False), ("scaling-rises", "scaling helix", True)):
        if table.short:
            break  # the largest helices are left out
        first, last = [row["kds"]["wrapped_pairs"] / row["beads"] for row in table.rows
                       if row["model"] == model and row["beads"] >= 640]
        table.claim(name, f"Pairs per bead {'rise' if grows else 'fall'} as the {model} is sampled more finely",
                    (first < last) == grows, f"{first:.2f} to {last:.2f}")
    table.finish()
