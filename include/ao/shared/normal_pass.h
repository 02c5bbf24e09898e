// The view-space shading normal of a pixel, from whatever the G-buffer holds.
// Callbacks: vec4 ao_load_normal(ivec2) (the texel as the API delivers it), real ao_load_depth(ivec2) (eye depth).
// Options:   int ao_normal_source (ao_normal_vector ... of encoding.h), bool ao_rotate_normals.

// Difference of view positions along one axis of the picture, from the neighbour nearer in depth.
// `step` is (1, 0) or (0, 1). Zero where both neighbours are background or outside.
AO_PASS vec3 ao_surface_step(ao_projection p, vec2 size, ivec2 pixel, vec3 position, int step_x, int step_y, bool parallel)
{
    ivec2 ahead = ivec2(pixel.x + integer(step_x), pixel.y + integer(step_y));
    ivec2 behind = ivec2(pixel.x - integer(step_x), pixel.y - integer(step_y));
    mask has_ahead = real(ahead.x) < size.x && real(ahead.y) < size.y;
    mask has_behind = behind.x >= integer(0) && behind.y >= integer(0);
    real depth_ahead = ao_load_depth(ivec2(mix(pixel.x, ahead.x, has_ahead), mix(pixel.y, ahead.y, has_ahead)));
    real depth_behind = ao_load_depth(ivec2(mix(pixel.x, behind.x, has_behind), mix(pixel.y, behind.y, has_behind)));
    mask usable_ahead = has_ahead && ao_is_surface(depth_ahead, real(1e30));
    mask usable_behind = has_behind && ao_is_surface(depth_behind, real(1e30));

    AO_PRECISE real gap_ahead = abs(depth_ahead + position.z);
    AO_PRECISE real gap_behind = abs(depth_behind + position.z);
    mask take_ahead = usable_ahead && (!usable_behind || gap_ahead <= gap_behind);
    mask take_any = usable_ahead || usable_behind;

    // Both differences, then the choice: where math<interval> leaves it open, either is bounded by itself.
    AO_PRECISE vec2 centre_ahead = vec2(real(ahead.x) + real(0.5), real(ahead.y) + real(0.5));
    AO_PRECISE vec2 centre_behind = vec2(real(behind.x) + real(0.5), real(behind.y) + real(0.5));
    vec3 next = ao_view_point(p, centre_ahead, mix(real(1), depth_ahead, usable_ahead), parallel);
    vec3 previous = ao_view_point(p, centre_behind, mix(real(1), depth_behind, usable_behind), parallel);
    AO_PRECISE vec3 forward = vec3(next.x - position.x, next.y - position.y, next.z - position.z);
    AO_PRECISE vec3 backward = vec3(position.x - previous.x, position.y - previous.y, position.z - previous.z);
    return ao_select(vec3(real(0), real(0), real(0)), ao_select(backward, forward, take_ahead), take_any);
}

// Normal of the surface through the pixel and its neighbours, towards the eye; +Z where there is none.
AO_PASS vec3 ao_normal_of_depth(ao_projection p, vec2 size, ivec2 pixel, vec3 position, bool parallel)
{
    vec3 along_x = ao_surface_step(p, size, pixel, position, 1, 0, parallel);
    vec3 along_y = ao_surface_step(p, size, pixel, position, 0, 1, parallel);
    vec3 normal = ao_cross(along_x, along_y);
    AO_PRECISE real away = parallel ? -normal.z : ao_dot(normal, position);
    mask turned = away > real(0);
    AO_PRECISE vec3 reversed = vec3(-normal.x, -normal.y, -normal.z);
    return ao_normalize_or(ao_select(normal, reversed, turned), vec3(real(0), real(0), real(1)));
}

// Unit normal in the space of a stored one; +Z where that is zero or not finite.
AO_PASS vec3 ao_stored_direction(ivec2 pixel)
{
    vec3 stored = ao_decoded_normal(ao_normal_source, ao_load_normal(pixel));
    return ao_normalize_or(stored, vec3(real(0), real(0), real(1)));
}

// Unit normal in view space from a stored one; +Z (towards the eye) where that is zero or not finite.
AO_PASS vec3 ao_stored_normal(ao_rotation to_view, ivec2 pixel)
{
    vec3 stored = ao_decoded_normal(ao_normal_source, ao_load_normal(pixel));
    if (ao_rotate_normals) {
        stored = ao_rotate(to_view, stored);
    }
    return ao_normalize_or(stored, vec3(real(0), real(0), real(1)));
}

// The same from whatever there is.
AO_PASS vec3 ao_shading_normal(ao_projection p, ao_rotation to_view, vec2 size, ivec2 pixel, vec3 position, bool parallel)
{
    if (ao_normal_source == ao_normal_from_depth) {
        return ao_normal_of_depth(p, size, pixel, position, parallel);
    }
    return ao_stored_normal(to_view, pixel);
}
