// Rays through a tree of boxes (bake_box.h). Callbacks: ao_bake_box ao_load_box(int node); vec3 ao_load_corner(int triangle, int
// corner). Options: bool ao_front_only: occluders count where they turn their front to the ray; bool ao_find_nearest: else any
// hit. N rays at once go wherever one of them goes. Visibility is the predicate's (bake_ray.h); boxes only leave out what it
// denies.

// 1 / x, of a magnitude that a product with a coordinate keeps finite.
AO_FN real ao_bake_inverse(real x)
{
    mask small = abs(x) < real(1e-18);
    AO_PRECISE real inverse = real(1) / mix(x, real(1e-18), small);
    return inverse;
}

// The depth at which a ray enters a box, or -1 where it does not within `reach`. Behind the start it is 0.
AO_FN real ao_bake_entry(ao_bake_box box, vec3 start, vec3 inverse, real reach)
{
    AO_PRECISE real x0 = (box.low.x - ao_bake_margin - start.x) * inverse.x;
    AO_PRECISE real x1 = (box.high.x + ao_bake_margin - start.x) * inverse.x;
    AO_PRECISE real y0 = (box.low.y - ao_bake_margin - start.y) * inverse.y;
    AO_PRECISE real y1 = (box.high.y + ao_bake_margin - start.y) * inverse.y;
    AO_PRECISE real z0 = (box.low.z - ao_bake_margin - start.z) * inverse.z;
    AO_PRECISE real z1 = (box.high.z + ao_bake_margin - start.z) * inverse.z;
    real enter = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), real(0)));
    real leave = min(min(max(x0, x1), max(y0, y1)), max(z0, z1));
    return mix(real(-1), enter, enter <= leave && enter <= reach);
}

AO_FN ao_bake_box ao_bake_chosen(ao_bake_box a, ao_bake_box b, bool first)
{
    if (first) {
        return a;
    }
    return b;
}

// The distance to the nearest occluder of each wanted ray within `reach`, or to any; -1 where there is none. `sign`: 1 along the
// line's d, -1 against it.
AO_PASS real ao_bake_trace(ao_bake_line line, real sign, vec3 start, real reach, mask wanted)
{
    ao_bake_point seen = ao_bake_seen(line, start);
    AO_PRECISE vec3 direction = vec3(line.dx * sign, line.dy * sign, line.dz * sign);
    vec3 inverse = vec3(ao_bake_inverse(direction.x), ao_bake_inverse(direction.y), ao_bake_inverse(direction.z));
    real nearest = real(-1);
    real within = ao_bake_beyond(reach);
    mask searching = wanted;
    int stack[ao_bake_stack];
    int top = 0;
    ao_bake_box box = ao_load_box(0);
    bool more = ao_any(searching && ao_bake_entry(box, start, inverse, within) >= real(0));
    while (more) {
        if (box.count > 0) {
            for (int i = box.first; i < box.first + box.count; ++i) {
                ao_bake_crossing crossing =
                    ao_bake_crossing_of(seen, ao_bake_seen(line, ao_load_corner(i, 0)), ao_bake_seen(line, ao_load_corner(i, 1)),
                                        ao_bake_seen(line, ao_load_corner(i, 2)));
                mask ahead = sign > real(0) && ao_bake_ahead(crossing, reach);
                mask behind = sign < real(0) && ao_bake_behind(crossing, reach);
                if (ao_front_only) {
                    ahead = ahead && crossing.turned;
                    behind = behind && !crossing.turned;
                }
                mask hit = searching && (ahead || behind);
                if (ao_any(hit)) {
                    real distance = ao_bake_distance(crossing);
                    mask nearer = hit && (nearest < real(0) || distance < nearest);
                    nearest = mix(nearest, distance, nearer);
                    if (ao_find_nearest) {
                        within = mix(within, ao_bake_beyond(distance), nearer);
                    }
                    else {
                        searching = searching && !hit;
                    }
                }
            }
            more = false;
        }
        else {
            ao_bake_box left = ao_load_box(box.first);
            ao_bake_box right = ao_load_box(box.first + 1);
            real left_entry = ao_bake_entry(left, start, inverse, within);
            real right_entry = ao_bake_entry(right, start, inverse, within);
            bool to_left = ao_any(searching && left_entry >= real(0));
            bool to_right = ao_any(searching && right_entry >= real(0));
            more = to_left || to_right;
            if (to_left && to_right) {
                bool left_first =
                    !ao_any(searching && left_entry >= real(0) && right_entry >= real(0) && right_entry < left_entry);
                stack[top] = left_first ? box.first + 1 : box.first;
                top = top + 1;
                box = ao_bake_chosen(left, right, left_first);
            }
            else if (more) {
                box = ao_bake_chosen(left, right, to_left);
            }
        }
        // What is left on the stack, unless nothing is searched for any more.
        if (!more && ao_any(searching)) {
            while (!more && top > 0) {
                top = top - 1;
                box = ao_load_box(stack[top]);
                more = ao_any(searching && ao_bake_entry(box, start, inverse, within) >= real(0));
            }
        }
    }
    return nearest;
}
