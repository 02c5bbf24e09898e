// A slice of the hemisphere about a normal: the half plane of the view vector V and a direction across, as 32 sectors from V on,
// bits of a word, each of the same weight. Directions in it are told by the cosine of their angle theta to V. Cosine-weighted, as
// ambient occlusion is, their weight is w(theta) = cos(theta - gamma) sin theta, gamma the angle from V to the normal's
// projection. Twice its integral from V on, where sin gamma is g, is g (theta - sin theta cos theta) + cos gamma sin^2 theta:
// smooth in c = cos theta, so that no angle is needed.

AO_CONST int ao_sector_count = 32;

// (arcsin c + c sqrt(1 - c^2)) / c on [-1, 1] as a polynomial in c^2, times c within 1.7e-3: less than 2e-3 of what a
// slice of weight 1 counts for.
AO_FN real ao_half_lens(real squared)
{
    AO_PRECISE real q = real(0.1034759755738966) + squared * real(-0.14782282234203206);
    q = real(-0.38803490882117664) + squared * q;
    q = real(2.0048470291655165) + squared * q;
    return q;
}

// The place of a direction among the sectors is start - c (lens * ao_half_lens(c^2) + square * c).
struct ao_slice {
    real start;
    real lens;
    real square;
    real tangent; // least height over the pixel, along V, of what stands over the tangent plane, per distance from V
    real weight;  // what it counts for: its share of the hemisphere, 0 to pi, on average over azimuths 1
    real sine;    // of gamma
    real cosine;
};

// `along`, `facing`: the normal's components in the slice, along the slice and along V; a normal that leans away from the eye
// counts as at a right angle to it.
AO_FN ao_slice ao_make_slice(real along, real facing)
{
    real up = max(facing, real(0));
    AO_PRECISE real length = sqrt(along * along + up * up);
    mask somewhere = length > real(1e-6);
    AO_PRECISE real inverse = real(1) / mix(real(1), length, somewhere);
    AO_PRECISE real sine = mix(real(0), along, somewhere) * inverse;
    AO_PRECISE real cosine = mix(real(1), up, somewhere) * inverse;
    AO_PRECISE real gamma = ao_turns(sine, cosine) * real(6.2831853071795865);
    // Up to the tangent plane, at gamma + pi / 2.
    AO_PRECISE real end = gamma + real(1.5707963267948966) + sine * cosine;
    AO_PRECISE real whole = sine * end + cosine * (cosine * cosine);
    real some = max(whole, real(1e-6));
    real steep = max(cosine, real(1e-4));
    // One division for scale and tangent.
    AO_PRECISE real both = real(1) / (some * steep);
    AO_PRECISE real scale = real(ao_sector_count) * (steep * both);
    AO_PRECISE real lens = scale * sine;
    AO_PRECISE real square = scale * cosine;
    AO_PRECISE real start = lens * real(1.5707963267948966) + square;
    AO_PRECISE real tangent = -sine * (some * both);
    AO_PRECISE real weight = max(length * whole, real(0));
    ao_slice slice = { start, lens, square, tangent, mix(real(0), weight, somewhere), sine, cosine };
    return slice;
}

// Nearest border between sectors, 0 to 32, of a direction whose angle to V has the cosine c.
AO_FN integer ao_sector_border(ao_slice slice, real c)
{
    AO_PRECISE real place = slice.start - c * (slice.lens * ao_half_lens(c * c) + slice.square * c);
    AO_PRECISE real inside = min(max(place + real(0.5), real(0)), real(32.5));
    return integer(inside);
}

// Sectors from a border on. 0 to 32.
AO_FN uint ao_sectors_from(integer border)
{
    mask none = border >= integer(ao_sector_count);
    uint from = uint(0xffffffffu) << uint(mix(border, integer(0), none));
    return mix(from, uint(0u), none);
}

// Numbers of sectors of a set in each quarter of the slice, from V on: bytes of a word, the lowest first.
AO_FN uint ao_sectors_by_eight(uint set)
{
    uint pairs = set - ((set >> 1) & uint(0x55555555u));
    uint fours = (pairs & uint(0x33333333u)) + ((pairs >> 2) & uint(0x33333333u));
    return (fours + (fours >> 4)) & uint(0x0f0f0f0fu);
}

// Number of sectors of a set.
AO_FN real ao_sectors_in(uint set)
{
    return real(integer((ao_sectors_by_eight(set) * uint(0x01010101u)) >> 24));
}
