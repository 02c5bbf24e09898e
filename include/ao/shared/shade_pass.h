// Forward shading from the geometry pass's targets (paper 1, stage 4; paper 4): every pixel with its object's material or blend
// of materials, the ambient term scaled by the visibility at the pixel. Include ao/shared/texture.h and shade_tables.h first.
// Callbacks: vec4 ao_load_geometry(ivec2): view-space position, or the depth buffer in x; vec4 ao_load_normal(ivec2);
//            vec4 ao_load_surface(ivec2); vec4 ao_load_frame(ivec2); uvec2 ao_load_ids(ivec2): the targets of gbuffer_facts;
//            real ao_load_visibility(ivec2); vec3 ao_load_bent_normal(ivec2), view space; vec4 ao_load_target(int, ivec2): what
//            an earlier ao_segment_pass returned; uint ao_load_word(uint): the table of shade_tables.h; uint ao_load_texel(uint):
//            the heap of texture.h; void ao_count_clamped(uint): weights at this pixel that were outside [0, 1] or NaN. Called
//            only where there are any.
// Options:   bool ao_stored_position (else depth), bool ao_parallel, int ao_normal_source, bool ao_use_visibility,
//            bool ao_use_maps, bool ao_use_reflections, bool ao_use_frames, bool ao_use_blends, bool ao_use_bent_normal,
//            bool ao_use_bounces. A callback whose option is off is not called.
// Control flow depends on the material: Real types whose mask is bool only.

struct ao_shade_constants {
    ao_projection projection;
    ao_depth_decode decode;
    ao_affine_map view_to_world; // a rotation; the translation is the eye in world space
    real root;                   // segments only: the blend whose pixels they shade,
    real first;                  // its first instruction's offset,
    real count;                  // and how many there are
    real reserved;
};

AO_PASS real ao_load_real(uint at)
{
    return ao_real_of_bits(ao_load_word(at));
}

AO_PASS vec3 ao_load_vector(uint at)
{
    vec3 v = vec3(ao_load_real(at), ao_load_real(at + uint(1)), ao_load_real(at + uint(2)));
    return v;
}

AO_PASS vec3 ao_load_map(uint map, vec2 uv, real footprint)
{
    return vec3(ao_sample(map - uint(1), uv, footprint));
}

AO_PASS vec3 ao_to_world(ao_shade_constants c, vec3 direction)
{
    return ao_transform_direction(c.view_to_world, direction);
}

AO_PASS ao_surface ao_load_pixel(ao_shade_constants c, ivec2 pixel)
{
    vec4 stored = ao_load_geometry(pixel);
    vec3 position = vec3(stored);
    if (!ao_stored_position) {
        AO_PRECISE vec2 centre = vec2(real(pixel.x) + real(0.5), real(pixel.y) + real(0.5));
        real d = ao_eye_depth(c.decode, centre, stored.x, ao_parallel);
        position = ao_view_point(c.projection, centre, d, ao_parallel);
    }
    vec3 upright = vec3(real(0), real(0), real(1));
    vec3 normal = ao_normalize_or(ao_decoded_normal(ao_normal_source, ao_load_normal(pixel)), upright);
    vec3 to_eye = upright;
    if (!ao_parallel) {
        AO_PRECISE vec3 back = vec3(-position.x, -position.y, -position.z);
        to_eye = ao_normalize_or(back, upright);
    }
    vec4 surface = vec4(real(0), real(0), real(0), real(1));
    if (ao_use_maps || ao_use_frames) {
        surface = ao_load_surface(pixel);
    }
    real visibility = real(1);
    if (ao_use_visibility) {
        // Marks of background and NaN count as open.
        real seen = ao_load_visibility(pixel);
        mask usable = seen >= real(0);
        visibility = min(mix(real(1), seen, usable), real(1));
    }
    vec3 opening = normal;
    if (ao_use_bent_normal) {
        opening = ao_normalize_or(ao_load_bent_normal(pixel), normal);
    }
    ao_surface s = { ao_to_world(c, position),
                     ao_to_world(c, normal),
                     ao_to_world(c, to_eye),
                     vec2(surface.x, surface.y),
                     surface.z,
                     surface.w,
                     visibility,
                     ao_to_world(c, opening) };
    return s;
}

AO_PASS vec3 ao_leaf_normal(ao_shade_constants c, uint material, uint kind, ao_surface s, vec2 uv, real footprint, ivec2 pixel)
{
    uint map = ao_load_word(material + uint(22));
    vec3 texel = vec3(real(0.5), real(0.5), real(1));
    if (kind == uint(ao_normal_of_map) && map != uint(0)) {
        texel = ao_load_map(map, uv, footprint);
    }
    vec3 normal = ao_normal_of_frame(ao_load_frame(pixel), texel, ao_load_real(material + uint(11)));
    return ao_to_world(c, ao_facing_normal(normal, s.side));
}

AO_PASS ao_ambient_light ao_load_ambient()
{
    uint at = ao_load_word(uint(ao_header_ambient));
    ao_ambient_light light = { ao_load_vector(at),
                               ao_load_vector(at + uint(3)),
                               ao_load_vector(at + uint(6)),
                               ao_load_vector(at + uint(9)),
                               ao_load_vector(at + uint(12)),
                               ao_load_vector(at + uint(15)),
                               ao_load_vector(at + uint(18)),
                               ao_load_vector(at + uint(21)),
                               ao_load_vector(at + uint(24)) };
    return light;
}

AO_PASS ao_light ao_load_light(ao_shade_constants c, uint at)
{
    vec3 vector = ao_load_vector(at);
    bool point = ao_load_word(at + uint(3)) != uint(0);
    if (point) {
        AO_PRECISE vec3 from_eye =
            vec3(vector.x - c.view_to_world.x.w, vector.y - c.view_to_world.y.w, vector.z - c.view_to_world.z.w);
        vector = from_eye;
    }
    ao_light light = { vector, ao_load_vector(at + uint(4)), ao_load_vector(at + uint(8)), point };
    return light;
}

// What a standard material sends to the eye.
AO_PASS vec3 ao_shade_leaf(ao_shade_constants c, uint index, uint normal_kind, ao_surface at_pixel, ivec2 pixel)
{
    ao_surface s = at_pixel;
    uint material = ao_load_word(uint(ao_header_materials)) + index * uint(ao_material_words);
    vec3 ambient = ao_load_vector(material);
    vec3 diffuse = ao_load_vector(material + uint(4));
    vec3 specular = ao_load_vector(material + uint(8));
    if (ao_use_maps) {
        AO_PRECISE vec2 uv = vec2(s.uv.x * ao_load_real(material + uint(16)), s.uv.y * ao_load_real(material + uint(17)));
        AO_PRECISE real footprint = s.footprint * ao_load_real(material + uint(18));
        if (ao_use_frames && normal_kind != uint(ao_normal_of_geometry)) {
            vec3 own = ao_leaf_normal(c, material, normal_kind, s, uv, footprint, pixel);
            vec3 opening = own;
            if (ao_use_bent_normal) {
                // Bent from the leaf's normal as far as from the geometry's.
                AO_PRECISE vec3 bent = vec3(own.x + (s.opening.x - s.normal.x), own.y + (s.opening.y - s.normal.y),
                                            own.z + (s.opening.z - s.normal.z));
                opening = ao_normalize_or(bent, own);
            }
            s.normal = own;
            s.opening = opening;
        }
        uint diffuse_map = ao_load_word(material + uint(19));
        if (diffuse_map != uint(0)) {
            vec3 color = ao_load_map(diffuse_map, uv, footprint);
            ambient = ao_product(ambient, color);
            diffuse = ao_product(diffuse, color);
        }
        uint specular_map = ao_load_word(material + uint(20));
        if (specular_map != uint(0)) {
            specular = ao_product(specular, ao_load_map(specular_map, uv, footprint));
        }
    }
    ao_reflectance m = { ambient, diffuse, specular, ao_load_real(material + uint(3)),
                         ao_load_word(material + uint(7)) != uint(0) };

    vec3 surrounding = vec3(real(0), real(0), real(0));
    if (ao_use_bounces) {
        surrounding = ao_bounced_ambient_term(m, s, ao_load_ambient());
    }
    else {
        surrounding = ao_ambient_term(m, s, ao_load_ambient());
    }
    vec3 color = ao_sum(surrounding, ao_load_vector(material + uint(12)));
    uint light = ao_load_word(uint(ao_header_lights));
    uint count = ao_load_word(uint(ao_header_light_count));
    for (uint i = uint(0); i < count; ++i) {
        ao_incident incident = ao_light_at(ao_load_light(c, light + i * uint(ao_light_words)), s);
        color = ao_sum(color, ao_reflected(m, s, incident));
    }
    if (ao_use_reflections) {
        uint reflection = ao_load_word(material + uint(21));
        if (reflection != uint(0)) {
            vec2 uv = ao_equirectangular(ao_mirrored(s.to_eye, s.normal));
            vec4 seen = ao_sample_around(reflection - uint(1), uv, ao_load_real(material + uint(15)));
            color = ao_sum(color, ao_product(specular, vec3(seen)));
        }
    }
    return color;
}

// Runs `count` instructions; the last one's result.
AO_PASS vec3 ao_run_program(ao_shade_constants c, uint first, uint count, ao_surface s, ivec2 pixel)
{
    vec3 registers[ao_register_limit];
    vec3 result = vec3(real(0), real(0), real(0));
    uint clamped = uint(0);
    for (uint i = uint(0); i < count; ++i) {
        uint at = first + i * uint(ao_instruction_words);
        uint code = ao_load_word(at);
        uint operation = code & uint(255);
        uint argument = ao_load_word(at + uint(1));
        uint detail = ao_load_word(at + uint(2));
        if (operation == uint(ao_leaf)) {
            result = ao_shade_leaf(c, argument, detail, s, pixel);
        }
        else if (operation == uint(ao_fetch)) {
            result = vec3(ao_load_target(int(argument), pixel));
        }
        else {
            real b = real(0);
            if (ao_use_maps && detail != uint(0)) {
                b = ao_sample(detail - uint(1), s.uv, s.footprint).x;
            }
            else {
                b = ao_load_real(ao_load_word(uint(ao_header_weights)) + argument);
            }
            if (!ao_is_mask(b)) {
                clamped += uint(1);
            }
            vec3 left = registers[code / uint(65536) & uint(15)];
            vec3 right = registers[code / uint(16777216) & uint(15)];
            result = ao_blend(left, right, ao_clamp_mask(b));
        }
        registers[code / uint(256) & uint(15)] = result;
    }
    if (clamped != uint(0)) {
        ao_count_clamped(clamped);
    }
    return result;
}

// Linear color with 1 in w; 0 on background and where segments are to follow.
AO_PASS vec4 ao_shade_pass(ao_shade_constants c, ivec2 pixel)
{
    vec4 nothing = vec4(real(0), real(0), real(0), real(0));
    uvec2 ids = ao_load_ids(pixel);
    if (ids.x == uint(0)) {
        return nothing;
    }
    // object::material + 1: above 0 a material, else less a blend.
    integer code = integer(ids.y);
    uint materials = ao_load_word(uint(ao_header_material_count));
    if (!ao_use_blends || code > integer(0)) {
        if (code <= integer(0) || ids.y > materials) {
            return nothing;
        }
        vec3 color = ao_shade_leaf(c, ids.y - uint(1), uint(ao_normal_of_geometry), ao_load_pixel(c, pixel), pixel);
        return vec4(color.x, color.y, color.z, real(1));
    }
    uint entry = materials + uint(-code);
    if (entry >= ao_load_word(uint(ao_header_entry_count))) {
        return nothing;
    }
    uint at = ao_load_word(uint(ao_header_entries)) + entry * uint(2);
    uint count = ao_load_word(at + uint(1));
    if (count == uint(0)) {
        return nothing;
    }
    vec3 blended = ao_run_program(c, ao_load_word(at), count, ao_load_pixel(c, pixel), pixel);
    return vec4(blended.x, blended.y, blended.z, real(1));
}

// Part of a blend that does not fit one pass: color with 1 in w, or -1 in w where nothing is to be written.
AO_PASS vec4 ao_segment_pass(ao_shade_constants c, ivec2 pixel)
{
    uvec2 ids = ao_load_ids(pixel);
    if (ids.x == uint(0) || integer(ids.y) != -integer(c.root)) {
        return vec4(real(0), real(0), real(0), real(-1));
    }
    vec3 color = ao_run_program(c, uint(c.first), uint(c.count), ao_load_pixel(c, pixel), pixel);
    return vec4(color.x, color.y, color.z, real(1));
}
