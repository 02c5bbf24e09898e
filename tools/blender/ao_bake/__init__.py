"""Bakes ambient occlusion of the active mesh into a colour attribute, by the program `ao bake` (docs/baking.md)."""

from array import array

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .process import Bake, BakeError, find_program

bl_info = {
    "name": "Ambient occlusion per vertex (ao)",
    "author": "ao",
    "version": (1, 0, 0),
    "blender": (3, 2, 0),
    "location": "View3D > Sidebar > AO",
    "description": "Bakes ambient occlusion into a colour attribute of the active mesh",
    "category": "Object",
}


class AO_preferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: StringProperty(
        name="Program", subtype="FILE_PATH", description="Path of the program ao; empty: AO_PROGRAM of the environment, else PATH"
    )

    def draw(self, _context):
        self.layout.prop(self, "program")


def mesh_in_world(item):
    """Positions and triangles of the object's own mesh, without modifiers, so that vertices are its own."""
    mesh = item.data.copy()
    try:
        mesh.transform(item.matrix_world)
        if item.matrix_world.determinant() < 0:
            mesh.flip_normals()
        mesh.calc_loop_triangles()
        positions = array("f", bytes(12 * len(mesh.vertices)))
        mesh.vertices.foreach_get("co", positions)
        triangles = array("i", bytes(12 * len(mesh.loop_triangles)))
        mesh.loop_triangles.foreach_get("vertices", triangles)
        return positions, triangles
    finally:
        bpy.data.meshes.remove(mesh)


def store(mesh, name, values):
    """Grey, opaque, one colour per vertex."""
    attribute = mesh.color_attributes.get(name)
    if attribute is not None and (attribute.domain != "POINT" or attribute.data_type != "FLOAT_COLOR"):
        mesh.color_attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.color_attributes.new(name, "FLOAT_COLOR", "POINT")
    colours = array("f", [1.0]) * (4 * len(values))
    for component in range(3):
        colours[component::4] = values
    attribute.data.foreach_set("color", colours)
    mesh.color_attributes.active_color = attribute
    mesh.update()


class AO_OT_bake(bpy.types.Operator):
    bl_idname = "object.ao_bake"
    bl_label = "Bake Ambient Occlusion"
    bl_description = "Bake ambient occlusion of the active mesh into a colour attribute"
    bl_options = {"REGISTER", "UNDO"}

    rule: StringProperty(name="Rule", default="lebedev:5810", description="Directions: lebedev:N, fibonacci:N, ...")
    coefficient: EnumProperty(
        name="Coefficient",
        items=[("uniform", "Uniform", "Share of open directions"), ("cosine", "Cosine", "Weighted by the cosine")],
    )
    distance: FloatProperty(name="Distance", default=0, min=0, description="Share of the model's diagonal; 0: no limit")
    falloff: EnumProperty(
        name="Fall-off", items=[(name, name.capitalize(), "") for name in ("none", "linear", "smooth")]
    )
    front_only: BoolProperty(name="Front faces only", description="For closed meshes")
    attribute: StringProperty(name="Attribute", default="AO")

    @classmethod
    def poll(cls, context):
        item = context.active_object
        return item is not None and item.type == "MESH" and item.mode == "OBJECT"

    def arguments(self):
        chosen = ["--rule", self.rule, "--coefficient", self.coefficient, "--falloff", self.falloff]
        if self.distance > 0:
            chosen += ["--distance", repr(self.distance)]
        if self.front_only:
            chosen += ["--sides", "front"]
        return chosen

    def start(self, context):
        item = context.active_object
        if not item.data.vertices or not item.data.polygons:
            raise BakeError(f"{item.name} has no faces")
        program = find_program(context.preferences.addons[__name__].preferences.program)
        self._mesh = item.data
        return Bake(program, *mesh_in_world(item), self.arguments())

    def finish(self, values):
        try:
            count = len(self._mesh.vertices)
        except ReferenceError:
            count = -1  # deleted
        if len(values) != count:
            raise BakeError("the mesh has changed since the bake began")
        store(self._mesh, self.attribute, values)
        self.report({"INFO"}, f"ambient occlusion of {len(values)} vertices, {min(values):.3f} to {max(values):.3f}")

    # From scripts, and without a window: waits.
    def execute(self, context):
        try:
            self.finish(self.start(context).values())
        except BakeError as wrong:
            self.report({"ERROR"}, str(wrong))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, _event):
        try:
            self._bake = self.start(context)
        except BakeError as wrong:
            self.report({"ERROR"}, str(wrong))
            return {"CANCELLED"}
        manager = context.window_manager
        manager.progress_begin(0, 1000)
        self._timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._bake.cancel()
            return self.leave(context, {"CANCELLED"}, "cancelled")
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if self._bake.running():
            context.window_manager.progress_update(int(1000 * self._bake.share))
            context.workspace.status_text_set(f"Ambient occlusion: {100 * self._bake.share:.0f} % (Esc cancels)")
            return {"RUNNING_MODAL"}
        try:
            self.finish(self._bake.values())
        except BakeError as wrong:
            self.report({"ERROR"}, str(wrong))
            return self.leave(context, {"CANCELLED"}, None)
        return self.leave(context, {"FINISHED"}, None)

    def leave(self, context, how, said):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        if said:
            self.report({"INFO"}, said)
        return how


class AO_PT_panel(bpy.types.Panel):
    bl_label = "Ambient Occlusion"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "AO"

    def draw(self, _context):
        self.layout.operator_context = "INVOKE_DEFAULT"
        self.layout.operator(AO_OT_bake.bl_idname)


classes = (AO_preferences, AO_OT_bake, AO_PT_panel)


def register():
    for each in classes:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(classes):
        bpy.utils.unregister_class(each)
