// Bent normals of the method `bitmask`: the mean unoccluded direction, cosine-weighted (Landis 2002), from the sectors of
// sectors.h that no column blocks. Directions are in view space. Include sectors.h and vector.h first.
//
// A pixel sees a few slices of all azimuths only. What is known of all of them, the mean of a whole hemisphere, 2/3 n, takes the
// place of the mean of its slices as a whole as far as the hemisphere is open: open + visibility (2/3 n - whole). So an open
// plane's bent normal is its normal, whichever slices a pixel has.

// Weighted means of unit directions.
struct ao_openness {
    vec3 open;  // over the open sectors, as a share of all of them
    vec3 whole; // over all sectors
};

// Mean over one quarter of a slice's sectors of the cosine or sine of the angle to V, as a polynomial in sine and cosine of
// gamma.
AO_FN real ao_quarter_mean(ao_slice slice, real constant, real sine, real cosine, real square)
{
    AO_PRECISE real mean = constant + slice.sine * (sine + slice.sine * square) + slice.cosine * cosine;
    return mean;
}

// `across`: unit, in the slice and at a right angle to `view`. The quarters' means are within 0.01 where the slice counts for 1
// or more and within 0.01 / weight elsewhere; all sectors of a quarter count as its mean.
AO_FN ao_openness ao_openness_of(ao_slice slice, vec3 view, vec3 across, uint blocked)
{
    uint counts = ao_sectors_by_eight(~blocked);
    AO_PRECISE vec4 share =
        vec4(real(integer(counts & uint(0xffu))) * real(0.03125), real(integer((counts >> 8) & uint(0xffu))) * real(0.03125),
             real(integer((counts >> 16) & uint(0xffu))) * real(0.03125), real(integer(counts >> 24)) * real(0.03125));
    vec4 cosines = vec4(ao_quarter_mean(slice, real(0.607969), real(-0.101405), real(0.326570), real(0.145134)),
                        ao_quarter_mean(slice, real(0.301162), real(-0.285896), real(0.489848), real(0.182792)),
                        ao_quarter_mean(slice, real(0.107616), real(-0.479872), real(0.504350), real(0.171145)),
                        ao_quarter_mean(slice, real(-0.039754), real(-0.735769), real(0.374971), real(0.124281)));
    vec4 sines = vec4(ao_quarter_mean(slice, real(0.654301), real(0.241435), real(-0.322620), real(-0.170172)),
                      ao_quarter_mean(slice, real(0.739600), real(0.360815), real(-0.133094), real(-0.124471)),
                      ao_quarter_mean(slice, real(0.712714), real(0.370501), real(0.073955), real(-0.107886)),
                      ao_quarter_mean(slice, real(0.589387), real(0.263507), real(0.344351), real(-0.128589)));
    AO_PRECISE real facing = cosines.x * share.x + cosines.y * share.y + cosines.z * share.z + cosines.w * share.w;
    AO_PRECISE real aside = sines.x * share.x + sines.y * share.y + sines.z * share.z + sines.w * share.w;
    // In the same order as above with all shares 1/4: a slice that is open is as it is as a whole, in every bit.
    AO_PRECISE real whole_facing =
        cosines.x * real(0.25) + cosines.y * real(0.25) + cosines.z * real(0.25) + cosines.w * real(0.25);
    AO_PRECISE real whole_aside = sines.x * real(0.25) + sines.y * real(0.25) + sines.z * real(0.25) + sines.w * real(0.25);
    AO_PRECISE vec3 open =
        vec3(view.x * facing + across.x * aside, view.y * facing + across.y * aside, view.z * facing + across.z * aside);
    AO_PRECISE vec3 whole = vec3(view.x * whole_facing + across.x * whole_aside, view.y * whole_facing + across.y * whole_aside,
                                 view.z * whole_facing + across.z * whole_aside);
    ao_openness openness = { open, whole };
    return openness;
}

AO_FN vec3 ao_add_weighted(vec3 sum, vec3 v, real weight)
{
    AO_PRECISE vec3 next = vec3(sum.x + v.x * weight, sum.y + v.y * weight, sum.z + v.z * weight);
    return next;
}

// The sum with another one, weighted.
AO_FN ao_openness ao_add_openness(ao_openness sum, ao_openness more, real weight)
{
    ao_openness next = { ao_add_weighted(sum.open, more.open, weight), ao_add_weighted(sum.whole, more.whole, weight) };
    return next;
}

// Between the passes a mean direction is one float: three whole numbers of 8 bits, 127 for 0. Exact for components that are
// multiples of 1/127.
AO_CONST int ao_packed_direction = 127;

// `v`: components in [-1, 1]; what is beyond is cut off.
AO_FN real ao_pack_direction(vec3 v)
{
    AO_PRECISE vec3 place = vec3(v.x * real(ao_packed_direction) + real(127.5), v.y * real(ao_packed_direction) + real(127.5),
                                 v.z * real(ao_packed_direction) + real(127.5));
    AO_PRECISE real codes = floor(min(max(place.x, real(0)), real(254))) +
                            floor(min(max(place.y, real(0)), real(254))) * real(256) +
                            floor(min(max(place.z, real(0)), real(254))) * real(65536);
    return codes;
}

// Components in 127ths.
AO_FN vec3 ao_unpack_direction(real codes)
{
    AO_PRECISE real z = floor(codes * real(0.0000152587890625));
    AO_PRECISE real rest = codes - z * real(65536);
    AO_PRECISE real y = floor(rest * real(0.00390625));
    AO_PRECISE vec3 v =
        vec3(rest - y * real(256) - real(ao_packed_direction), y - real(ao_packed_direction), z - real(ao_packed_direction));
    return v;
}

AO_FN ao_openness ao_unpack_openness(real open, real whole)
{
    ao_openness openness = { ao_unpack_direction(open), ao_unpack_direction(whole) };
    return openness;
}

// Unit, less than a right angle from the normal; the normal itself where nothing is open.
AO_FN vec3 ao_bent_normal_of(ao_openness mean, real visibility, vec3 normal)
{
    AO_PRECISE vec3 bent = vec3(mean.open.x + visibility * (normal.x * real(0.66666667) - mean.whole.x),
                                mean.open.y + visibility * (normal.y * real(0.66666667) - mean.whole.y),
                                mean.open.z + visibility * (normal.z * real(0.66666667) - mean.whole.z));
    real along = ao_dot(bent, normal);
    return ao_normalize_or(ao_select(normal, bent, along > real(1e-3)), normal);
}

AO_FN real ao_rounded_for_half(real x)
{
    AO_PRECISE real rounded = floor(x * real(2048) + real(0.5)) * real(0.00048828125);
    return rounded;
}

// What is stored: visibility and direction in multiples of 1/2048, which half floats hold exactly, for stores to those truncate
// on some drivers.
AO_FN vec4 ao_bent_texel(real visibility, vec3 bent)
{
    vec4 texel = vec4(ao_rounded_for_half(visibility), ao_rounded_for_half(bent.x), ao_rounded_for_half(bent.y),
                      ao_rounded_for_half(bent.z));
    return texel;
}
