"""Inside Blender, without a window: installs the add-on from its zip, bakes, and provokes every error that a user can meet.
blender --background --factory-startup --python-exit-code 1 --python addon.py -- ADDON.zip PROGRAM"""

import math
import sys
import time
from array import array

import bpy

archive, program = sys.argv[sys.argv.index("--") + 1 :]


def check(holds, what):
    if not holds:
        raise AssertionError(what)


def refused(part, **options):
    """bpy.ops raises what an operator reports as an error."""
    try:
        bpy.ops.object.ao_bake(**options)
    except RuntimeError as wrong:
        check(part in str(wrong), f"{part!r} is not in {str(wrong)!r}")
    else:
        raise AssertionError(f"not refused: {part}")


def attribute(item, name="AO"):
    colours = array("f", bytes(16 * len(item.data.vertices)))
    item.data.color_attributes[name].data.foreach_get("color", colours)
    check(set(colours[3::4]) == {1.0} and colours[0::4] == colours[2::4], "the colours are opaque and grey")
    return colours[0::4]


def mean(values):
    return sum(values) / len(values)


def alone(make, **options):
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    make(**options)
    return bpy.context.active_object


bpy.ops.preferences.addon_install(filepath=archive, overwrite=True)
bpy.ops.preferences.addon_enable(module="ao_bake")
preferences = bpy.context.preferences.addons["ao_bake"].preferences

preferences.program = "/nowhere/ao"
cube = alone(bpy.ops.mesh.primitive_cube_add)
refused("was not found")
preferences.program = program

# Convex: exactly 1, mirrored and stretched too.
cube.scale = (-1, 2, 3)
cube.location = (1e4, 0, 0)
bpy.context.view_layer.update()
check(bpy.ops.object.ao_bake(rule="fibonacci:200") == {"FINISHED"}, "a bake finishes")
check(set(attribute(cube)) == {1.0}, "a cube is open everywhere")

# A torus: its inside is darker than its outside, alike by symmetry.
torus = alone(bpy.ops.mesh.primitive_torus_add, major_segments=32, minor_segments=12)
check(bpy.ops.object.ao_bake(rule="lebedev:1202", attribute="shade") == {"FINISHED"}, "a bake finishes")
shade = attribute(torus, "shade")
across = [math.hypot(vertex.co[0], vertex.co[1]) for vertex in torus.data.vertices]
inside = [s for s, r in zip(shade, across) if r < min(across) + 1e-4]
outside = [s for s, r in zip(shade, across) if r > max(across) - 1e-4]
check(len(inside) == 32 and len(outside) == 32, "the torus has two rims of 32 vertices")
check(min(outside) > 0.99, f"the outer rim is open: {min(outside)}")
check(0.3 < mean(inside) < 0.9 and max(inside) - min(inside) < 0.03, f"the inner rim is shaded evenly: {inside}")
check(torus.data.color_attributes.active_color.name == "shade", "the baked attribute is active")

# Nearer occluders only, and once more into the same attribute.
bpy.ops.object.ao_bake(rule="lebedev:1202", attribute="shade", distance=0.05, falloff="smooth")
nearer = attribute(torus, "shade")
check(all(a >= b - 1e-3 for a, b in zip(nearer, shade)) and mean(nearer) > mean(shade), "less occludes")

refused("ao: ", rule="nothing:7")
refused("fall-off", falloff="linear")
torus.data.clear_geometry()
refused("has no faces")

# What the interface does while a bake runs: asks for progress, cancels.
process = sys.modules["ao_bake.process"]
grid = alone(bpy.ops.mesh.primitive_grid_add, x_subdivisions=400, y_subdivisions=400)
for vertex in grid.data.vertices:
    vertex.co[2] = 0.05 * math.sin(50 * vertex.co[0]) * math.sin(50 * vertex.co[1])
started = process.Bake(program, *sys.modules["ao_bake"].mesh_in_world(grid), ["--rule", "lebedev:5810"])
deadline = time.monotonic() + 120
while started.running() and started.share == 0 and time.monotonic() < deadline:
    time.sleep(0.05)
check(started.running() and started.share > 0, "progress is shown while the bake runs")
started.cancel()
check(not started.running(), "a cancelled bake is over")

print("blender add-on: all checks passed")
