// What the geometry pass computes per fragment (paper 1, stage 1), from what a rasterizer interpolated in its own way. Include
// ao/shared/texture.h first where maps are read from the heap.
// Callbacks: ao_geometry_material ao_load_material(uint): a row of the table of materials;
//            vec4 ao_load_alpha_map(ao_geometry_material, ao_map_place), vec4 ao_load_normal_map(ao_geometry_material,
//            ao_map_place): ao_sample of the heap, or the driver's own sampler.
// Options:   bool ao_use_alpha_map, bool ao_use_normal_map, int ao_normal_encoding (normal_source). A callback whose option is
//            off is not called.

AO_FN ao_map_place ao_scaled_place(ao_map_place p, ao_geometry_material m)
{
    AO_PRECISE vec2 uv = vec2(p.uv.x * m.scale.x, p.uv.y * m.scale.y);
    AO_PRECISE vec2 along_x = vec2(p.along_x.x * m.scale.x, p.along_x.y * m.scale.y);
    AO_PRECISE vec2 along_y = vec2(p.along_y.x * m.scale.x, p.along_y.y * m.scale.y);
    AO_PRECISE real footprint = p.footprint * m.footprint;
    ao_map_place scaled = { uv, along_x, along_y, footprint };
    return scaled;
}

// Whether the fragment is discarded.
AO_PASS bool ao_geometry_cut(uint leaf, ao_map_place place)
{
    if (!ao_use_alpha_map) {
        return false;
    }
    ao_geometry_material m = ao_load_material(leaf);
    vec4 texel = ao_load_alpha_map(m, ao_scaled_place(place, m));
    real alpha = m.alpha_from_red != uint(0) ? texel.x : texel.w;
    return alpha < m.cutoff;
}

// The target `normal`, of an interpolated normal and tangent. `side`: +1 seen from the front, -1 from behind.
AO_PASS vec4 ao_geometry_normal(uint leaf, ao_map_place place, vec3 normal, vec4 tangent, real side)
{
    vec3 n = ao_normalize_or(normal, vec3(real(0), real(0), real(1)));
    if (ao_use_normal_map) {
        ao_geometry_material m = ao_load_material(leaf);
        vec4 texel = ao_load_normal_map(m, ao_scaled_place(place, m));
        real handedness = tangent.w < real(0) ? real(-1) : real(1);
        n = ao_mapped_normal(normal, vec3(tangent), handedness, vec3(texel), m.green);
    }
    return ao_encoded_normal(ao_normal_encoding, ao_facing_normal(n, side));
}

// The target `motion` of the point seen at `pixel` that was at `previous` in the last frame's view space: z is its eye depth
// then, 0 where it was behind the eye.
AO_FN vec4 ao_geometry_motion(ao_geometry_camera c, vec3 previous, vec2 pixel)
{
    vec2 before = ao_to_pixel(c.previous_projection, previous, c.previous_parallel != uint(0));
    AO_PRECISE vec2 moved = vec2(before.x - pixel.x, before.y - pixel.y);
    real depth = mix(real(0), -previous.z, previous.z < real(0));
    vec4 motion = vec4(moved.x, moved.y, depth, real(0));
    return motion;
}

// The target `surface`.
AO_FN vec4 ao_geometry_surface(ao_map_place place, real side)
{
    vec4 surface = vec4(place.uv.x, place.uv.y, place.footprint, side);
    return surface;
}

// The target `frame` of objects that fill it.
AO_FN vec4 ao_geometry_frame(vec3 normal, vec4 tangent)
{
    real handedness = tangent.w < real(0) ? real(-1) : real(1);
    return ao_packed_frame(normal, vec3(tangent), handedness);
}
