// Of the routes `packed` and `raster`: all points as seen along the launch's lines. Rows of groups are lines.
//     void ao_store_seen(uint i, vec4 seen)

void ao_bake_main(ao_bake_launch launch)
{
    uint point = gl_GlobalInvocationID.x;
    uint row = gl_WorkGroupID.y;
    if (point < launch.points) {
        ao_bake_point seen = ao_bake_seen(ao_stored_line(launch.first_line + row), ao_load_point(point).xyz);
        ao_store_seen(row * launch.pitch + point, vec4(seen.u, seen.w, seen.d, 0.0));
    }
}
