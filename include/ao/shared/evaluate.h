// One entry to every shared function, for conformance: ao_evaluate(function, a, b) passes the eight numbers of a and b to
// the function and returns what it returns, padded with zeros. ao/conformance/functions.hpp lists names and inputs.
// Include ao/shared/functions.h first.

AO_CONST int ao_of_sum = 0; // the elementary operations first: they tell a driver's fault from ours
AO_CONST int ao_of_product = 1;
AO_CONST int ao_of_quotient = 2;
AO_CONST int ao_of_sqrt = 3;
AO_CONST int ao_of_floor = 4;
AO_CONST int ao_of_bounds = 5;
AO_CONST int ao_of_conversion = 6;
AO_CONST int ao_of_select = 7;
AO_CONST int ao_of_dot = 8;
AO_CONST int ao_of_cross = 9;
AO_CONST int ao_of_normalize_or = 10;
AO_CONST int ao_of_rotate = 11;
AO_CONST int ao_of_any_tangent = 12;
AO_CONST int ao_of_tangent = 13;
AO_CONST int ao_of_bitangent = 14;
AO_CONST int ao_of_radical_inverse_2 = 15; // the index in halves: high 16 bits in a.x, low ones in a.y
AO_CONST int ao_of_radical_inverse_3 = 16;
AO_CONST int ao_of_radical_inverse_5 = 17;
AO_CONST int ao_of_radical_inverse_7 = 18;
AO_CONST int ao_of_radical_inverse_11 = 19;
AO_CONST int ao_of_radical_inverse_13 = 20;
AO_CONST int ao_of_unorm_code = 21;
AO_CONST int ao_of_signed_from_code = 22;
AO_CONST int ao_of_octahedral_direction = 23;
AO_CONST int ao_of_view_point = 24;
AO_CONST int ao_of_view_point_parallel = 25;
AO_CONST int ao_of_to_pixel = 26;
AO_CONST int ao_of_to_pixel_parallel = 27;
AO_CONST int ao_of_eye_depth = 28;
AO_CONST int ao_of_eye_depth_affine = 29;
AO_CONST int ao_of_tile_texel = 30;
AO_CONST int ao_of_log2 = 31;
AO_CONST int ao_of_exp2 = 32;
AO_CONST int ao_of_power = 33;
AO_CONST int ao_of_srgb = 34;
AO_CONST int ao_of_turns = 35;
AO_CONST int ao_of_mapped_normal = 36;
AO_CONST int ao_of_packed_frame = 37;
AO_CONST int ao_of_transform_normal = 38;
AO_CONST int ao_of_blend = 39;
AO_CONST int ao_of_highlight = 40;
AO_CONST int ao_function_count = 41;

AO_FN vec4 ao_padded(vec3 v)
{
    vec4 padded = vec4(v.x, v.y, v.z, real(0));
    return padded;
}

AO_FN vec4 ao_evaluate_elementary(int function, vec4 a, vec4 b)
{
    if (function == ao_of_sum) {
        AO_PRECISE vec4 sum = vec4(a.x + b.x, a.y - b.y, a.z + b.z + b.w, -a.w);
        return sum;
    }
    if (function == ao_of_product) {
        AO_PRECISE vec4 product = vec4(a.x * b.x, a.y * b.y + a.z, a.z * b.z * a.w, a.x * b.y - b.x * a.y);
        return product;
    }
    if (function == ao_of_quotient) {
        AO_PRECISE vec4 quotient = vec4(a.x / b.x, a.y / b.y, real(1) / b.z, a.w / b.w);
        return quotient;
    }
    if (function == ao_of_sqrt) {
        AO_PRECISE vec4 root = vec4(sqrt(a.x), sqrt(a.y), sqrt(a.z), sqrt(a.w));
        return root;
    }
    if (function == ao_of_floor) {
        AO_PRECISE vec4 whole = vec4(floor(a.x), floor(a.y), floor(a.z), floor(a.w));
        return whole;
    }
    if (function == ao_of_bounds) {
        AO_PRECISE vec4 bounds = vec4(min(a.x, b.x), max(a.y, b.y), abs(a.z), min(max(a.w, real(0)), real(1)));
        return bounds;
    }
    AO_PRECISE vec4 converted =
        vec4(real(integer(a.x)), real(uint(b.x)), real(integer(a.y) + integer(a.z)), real(uint(b.y) * uint(b.z)));
    return converted;
}

AO_FN vec4 ao_evaluate_radical_inverse(int function, vec4 a)
{
    int dimension = function - ao_of_radical_inverse_2;
    uint index = uint(a.x) * uint(65536) + uint(a.y);
    int base = ao_halton_base(dimension);
    AO_PRECISE real inverse = ao_radical_inverse(base, index);
    return vec4(inverse, real(base), real(ao_halton_digits(base)), ao_halton_scale(base));
}

AO_FN vec4 ao_evaluate_projection(int function, vec4 a, vec4 b)
{
    // The constants of both directions, so that each function finds its own.
    ao_projection p = { a.x, a.y, a.z, a.w, a.x, a.y, a.z, a.w };
    if (function == ao_of_view_point || function == ao_of_view_point_parallel) {
        return ao_padded(ao_view_point(p, vec2(b.x, b.y), b.z, function == ao_of_view_point_parallel));
    }
    if (function == ao_of_to_pixel || function == ao_of_to_pixel_parallel) {
        vec2 pixel = ao_to_pixel(p, vec3(b), function == ao_of_to_pixel_parallel);
        return vec4(pixel.x, pixel.y, real(0), real(0));
    }
    ao_depth_decode c = { a.x, a.y, a.z, a.w, b.w, real(1e6), real(1), real(0) };
    AO_PRECISE real depth = ao_eye_depth(c, vec2(b.y, b.z), b.x, function == ao_of_eye_depth_affine);
    return vec4(depth, real(0), real(0), real(0));
}

AO_FN vec4 ao_evaluate_shading(int function, vec4 a, vec4 b)
{
    if (function == ao_of_log2) {
        return vec4(ao_log2(a.x), ao_log2(a.y), ao_log2(a.z), ao_log2(a.w));
    }
    if (function == ao_of_exp2) {
        return vec4(ao_exp2(a.x), ao_exp2(a.y), ao_exp2(a.z), ao_exp2(a.w));
    }
    if (function == ao_of_power) {
        AO_PRECISE real exponent = a.y * real(8192);
        return vec4(ao_power(a.x, real(2.5)), ao_power(abs(a.x), exponent), ao_power(abs(a.y), real(20)), real(0));
    }
    if (function == ao_of_srgb) {
        return vec4(ao_srgb_of_linear(a.x), ao_srgb_code(a.x), ao_srgb_of_linear(a.y), ao_srgb_code(a.y));
    }
    if (function == ao_of_turns) {
        return vec4(ao_turns(a.x, a.y), ao_turns(a.z, a.w), ao_turns(b.x, b.y), ao_turns(b.z, b.w));
    }
    if (function == ao_of_mapped_normal) {
        return ao_padded(ao_mapped_normal(vec3(a), vec3(b), real(-1), vec3(real(0.7), real(0.4), real(0.9)), real(1)));
    }
    if (function == ao_of_packed_frame) {
        return ao_packed_frame(vec3(a), vec3(b), real(-1));
    }
    if (function == ao_of_transform_normal) {
        ao_affine_map m = { a, b, vec4(a.y, b.z, a.w, b.x) };
        return ao_padded(ao_transform_normal(m, vec3(b.w, a.x, b.y)));
    }
    if (function == ao_of_blend) {
        return ao_padded(ao_blend(vec3(a), vec3(b), ao_clamp_mask(a.w)));
    }
    vec3 none = vec3(real(0), real(0), real(0));
    ao_reflectance m = { none, none, none, real(50), false };
    ao_reflectance mirror = { none, none, none, real(20), true };
    vec3 helper = ao_normalize_or(vec3(b), vec3(a));
    return vec4(ao_highlight(m, vec3(a), helper, vec3(a)), ao_highlight(mirror, vec3(a), helper, helper), real(0), real(0));
}

AO_FN vec4 ao_evaluate(int function, vec4 a, vec4 b)
{
    if (function >= ao_of_log2) {
        return ao_evaluate_shading(function, a, b);
    }
    if (function <= ao_of_conversion) {
        return ao_evaluate_elementary(function, a, b);
    }
    if (function >= ao_of_radical_inverse_2 && function <= ao_of_radical_inverse_13) {
        return ao_evaluate_radical_inverse(function, a);
    }
    if (function >= ao_of_view_point && function <= ao_of_eye_depth_affine) {
        return ao_evaluate_projection(function, a, b);
    }
    if (function == ao_of_select) {
        return ao_padded(ao_select(vec3(a), vec3(b), a.w < b.w));
    }
    if (function == ao_of_dot) {
        return vec4(ao_dot(vec3(a), vec3(b)), real(0), real(0), real(0));
    }
    if (function == ao_of_cross) {
        return ao_padded(ao_cross(vec3(a), vec3(b)));
    }
    if (function == ao_of_normalize_or) {
        return ao_padded(ao_normalize_or(vec3(a), vec3(b)));
    }
    if (function == ao_of_rotate) {
        ao_rotation m = { a.x, a.y, a.z, real(0), a.w, b.x, b.y, real(0), b.z, b.w, a.x, real(0) };
        return ao_padded(ao_rotate(m, vec3(b.w, a.y, b.x)));
    }
    if (function == ao_of_any_tangent) {
        return ao_padded(ao_any_tangent(vec3(a)));
    }
    if (function == ao_of_tangent || function == ao_of_bitangent) {
        ao_frame frame = ao_gram_schmidt(vec3(a), vec3(b));
        if (function == ao_of_tangent) {
            return ao_padded(frame.tangent);
        }
        return ao_padded(frame.bitangent);
    }
    if (function == ao_of_unorm_code) {
        return vec4(ao_unorm_code(a.x, b.x), ao_unorm_code(a.y, b.x), ao_unorm_code(a.z, b.x), real(0));
    }
    if (function == ao_of_signed_from_code) {
        return vec4(ao_signed_from_code(a.x, b.x), ao_signed_from_code(a.y, b.x), ao_signed_from_code(a.z, b.x), real(0));
    }
    if (function == ao_of_octahedral_direction) {
        return ao_padded(ao_octahedral_direction(a.x, a.y));
    }
    ivec2 texel = ao_tile_texel(ivec2(integer(a.x), integer(a.y)));
    return vec4(real(texel.x), real(texel.y), real(0), real(0));
}
