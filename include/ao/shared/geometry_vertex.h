// The geometry pass's buffers and what it computes per vertex (paper 1, stage 1). In C++, std140 and std430 the structs lie
// alike; ao/drawing.hpp fills them.

struct ao_geometry_camera {
    ao_affine_map view;
    ao_affine_map clip; // rows x, y and z of the projection; y grows with the rows in memory
    vec4 clip_w;        // row w
    ao_affine_map previous_view;
    ao_projection previous_projection;
    uint previous_parallel;
    uint reserved_0;
    uint reserved_1;
    uint reserved_2;
};

struct ao_geometry_instance {
    ao_affine_map model;
    uint object; // object + 1
    uint code;   // object::material + 1
    uint leaf;   // the material that gives the geometry its maps
    real handed; // -1 where the model matrix mirrors, else +1
};

// Maps are indices into the heap.
struct ao_geometry_material {
    vec2 scale;     // uv is multiplied by it,
    real footprint; // and the footprint by this
    real cutoff;
    uint alpha_map;
    uint alpha_from_red;
    uint normal_map;
    real green; // +1 up, -1 down
};

// View space.
AO_FN vec3 ao_vertex_position(ao_affine_map view, ao_affine_map model, vec3 position)
{
    return ao_transform_point(view, ao_transform_point(model, position));
}

AO_FN vec4 ao_vertex_clip(ao_affine_map clip, vec4 clip_w, vec3 position)
{
    AO_PRECISE real w = clip_w.x * position.x + clip_w.y * position.y + clip_w.z * position.z + clip_w.w;
    vec3 moved = ao_transform_point(clip, position);
    vec4 at = vec4(moved.x, moved.y, moved.z, w);
    return at;
}

// View space, of any length.
AO_FN vec3 ao_vertex_normal(ao_affine_map view, ao_affine_map model, vec3 normal)
{
    return ao_transform_direction(view, ao_transform_normal(model, normal));
}

// View space, of any length; w is the handedness.
AO_FN vec4 ao_vertex_tangent(ao_affine_map view, ao_geometry_instance object, vec4 tangent)
{
    vec3 turned = ao_transform_direction(view, ao_transform_direction(object.model, vec3(tangent)));
    AO_PRECISE real handedness = tangent.w * object.handed;
    vec4 moved = vec4(turned.x, turned.y, turned.z, handedness);
    return moved;
}
