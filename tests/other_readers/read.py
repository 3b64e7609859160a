"""Of tests/other_readers/run: what Blender makes of a film, beside the run's own table of poses."""
import json
import re
import sys

import numpy

MOMENTS = 1000
NEAR_IMPACT = 0.005  # [s]
BOUND = 1.5e-4       # [m, rad] the film's 1e-4, and the rounding of Blender's frames in single precision
LEAST_COVERED = 0.97


def scene_of(path):
    with open(path, encoding="utf-8") as file:
        return json.loads(re.sub(r"(^|\s)//.*$", "", file.read(), flags=re.MULTILINE))


def beginning(path, begin, out):
    """The scene with a film that begins at a moment of the run."""
    scene = scene_of(path)
    begin = float(begin)
    scene["film"]["time"] = [[0, begin], [scene["duration"] - begin, scene["duration"]]]
    with open(out, "w", encoding="utf-8") as file:
        json.dump(scene, file)


def rows_of(run):
    """Indices of rows of the table, half of them near an impact."""
    random = numpy.random.default_rng(1)
    times = run["time"]
    near = numpy.abs(times[:, None] - run["impact_time"][None, :]).min(axis=1) <= NEAR_IMPACT
    return numpy.concatenate([random.choice(numpy.flatnonzero(near), MOMENTS // 2),
                              random.choice(len(times), MOMENTS - MOMENTS // 2)])


def poses(film, table, scene):
    import bpy
    from mathutils import Quaternion
    numpy.bool = bool  # the importer of Blender 3.4 has this name, which NumPy 1.24 has no more; Debian 12 has both
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=film)
    shown = bpy.context.scene
    run = numpy.load(table)
    keys = numpy.array(scene_of(scene).get("film", {}).get("time", [[0, 0], [1e9, 1e9]]))
    # The importer turns z up by (x, y, z) -> (x, -z, y) in each node's own axes too, meshes and all.
    own_axes = Quaternion((0.5 ** 0.5, -0.5 ** 0.5, 0, 0))
    sizes = {str(name): box["half_extents"] for name, box in zip(run["box"], scene_of(scene)["boxes"])}
    signs = numpy.array(numpy.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
    place = angle = corner = 0.0
    for row in rows_of(run):
        frame = float(numpy.interp(run["time"][row], keys[:, 1], keys[:, 0])) * shown.render.fps
        shown.frame_set(int(frame), subframe=frame - int(frame))
        for column, name in enumerate(run["box"]):
            shape = bpy.data.objects[str(name)]
            at, turn, _ = shape.matrix_world.decompose()
            expected = [run[key][row, column] for key in ("x", "y", "z")]
            place = max(place, float(numpy.linalg.norm(numpy.array(at) - expected)))
            own = Quaternion([run[key][row, column] for key in ("qw", "qx", "qy", "qz")])
            sine = min(1.0, numpy.linalg.norm(((own @ own_axes).conjugated() @ turn)[1:]))
            angle = max(angle, 2 * float(numpy.arcsin(sine)))
            turned = numpy.array(own.to_matrix())
            corners = numpy.array(expected) + (signs * sizes[str(name)]) @ turned.T
            for vertex in shape.data.vertices:
                distances = numpy.linalg.norm(corners - numpy.array(shape.matrix_world @ vertex.co), axis=1)
                corner = max(corner, float(distances.min()))
    print(f"found: {len(run['box'])} boxes at {MOMENTS} moments, off by at most {place:.2e} m and {angle:.2e} rad; "
          f"corners {corner:.2e} m")
    return place <= BOUND and angle <= BOUND and corner <= 2 * BOUND


def covered(path):
    """Which pixels the box covers: it alone is red. It is convex, so that pips and dark edges are within its rows."""
    import bpy
    picture = bpy.data.images.load(path)
    width, height = picture.size
    red, green, blue = numpy.array(picture.pixels[:]).reshape(height, width, 4)[:, :, :3].transpose(2, 0, 1)
    seen = (red > 1.5 * green) & (red > 1.5 * blue) & (red > 0.08)
    return numpy.logical_or.accumulate(seen, axis=1) & numpy.logical_or.accumulate(seen[:, ::-1], axis=1)[:, ::-1]


def cover(still, other):
    import os
    one, two = covered(os.path.abspath(still)), covered(os.path.abspath(other))
    both = (one & two).sum() / max(1, (one | two).sum())
    print(f"found: the box covers {one.sum()} pixels, {two.sum()} in F3D; {both:.3f} of both together are the same")
    return both >= LEAST_COVERED and one.sum() > 1000


if __name__ == "__main__":
    command, *arguments = sys.argv[sys.argv.index("--") + 1:]
    good = {"poses": poses, "cover": cover, "beginning": beginning}[command](*arguments)
    sys.exit(0 if good is None or good else 1)
