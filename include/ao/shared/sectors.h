// A slice through the hemisphere about a normal as 32 sectors, bits of a word, each of the same weight. Directions of a slice are
// told by the cosine of their angle to the view vector V, on either side of it; cosine-weighted, as ambient occlusion is, their
// weight is w(theta) = cos(theta - gamma) |sin theta|, gamma the angle from V to the normal's projection.
// Twice the antiderivative of w from V on, on the side where sin gamma is g, is g (theta - sin theta cos theta) + cos gamma
// sin^2 theta: smooth in c = cos theta, so that no angle is needed.

AO_CONST int ao_sector_count = 32;

// (arcsin c + c sqrt(1 - c^2)) / c on [-1, 1] as a polynomial in c^2, times c within 1.7e-3: a fortieth of a sector at most.
AO_FN real ao_half_lens(real squared)
{
    AO_PRECISE real q = real(0.1034759755738966) + squared * real(-0.14782282234203206);
    q = real(-0.38803490882117664) + squared * q;
    q = real(2.0048470291655165) + squared * q;
    return q;
}

// One side of a slice: the place of a direction among the sectors is start - c (lens * ao_half_lens(c^2) + square * c).
struct ao_slice_side {
    real start;
    real lens;
    real square;
    real tangent; // least height over the pixel, along V, of what stands over the tangent plane, per distance from V
};

// What a slice adds to the pixel's visibility counts for: its share of the hemisphere, 0 to pi / 2.
struct ao_slice {
    ao_slice_side right;
    ao_slice_side left;
    real weight;
};

// `along`, `facing`: the normal's components in the slice, along the slice and along V; a normal that leans away from the eye
// counts as at a right angle to it.
AO_FN ao_slice ao_make_slice(real along, real facing)
{
    real up = max(facing, real(0));
    AO_PRECISE real length = sqrt(along * along + up * up);
    mask somewhere = length > real(1e-6);
    AO_PRECISE real sine = along / mix(real(1), length, somewhere);
    AO_PRECISE real cosine = mix(real(1), up / mix(real(1), length, somewhere), somewhere);
    sine = mix(real(0), sine, somewhere);
    AO_PRECISE real gamma = ao_turns(sine, cosine) * real(6.2831853071795865);
    AO_PRECISE real whole = gamma * sine + cosine;
    AO_PRECISE real scale = real(0.5) * real(ao_sector_count) / whole;
    // Sectors before V: all of the left side.
    AO_PRECISE real centre = (cosine + (gamma - real(1.5707963267948966)) * sine) * scale;
    AO_PRECISE real lens = scale * sine;
    AO_PRECISE real square = scale * cosine;
    AO_PRECISE real turn = lens * real(1.5707963267948966);
    AO_PRECISE real tangent = sine / max(cosine, real(1e-4));
    AO_PRECISE real right_start = centre + (turn + square);
    AO_PRECISE real left_start = centre - (square - turn);
    AO_PRECISE real weight = length * whole;
    ao_slice_side right = { right_start, lens, square, -tangent };
    ao_slice_side left = { left_start, lens, -square, tangent };
    ao_slice slice = { right, left, mix(real(0), weight, somewhere) };
    return slice;
}

// Nearest border between sectors, 0 to 32, of a direction whose angle to V has the cosine c.
AO_FN integer ao_sector_border(ao_slice_side side, real c)
{
    AO_PRECISE real place = side.start - c * (side.lens * ao_half_lens(c * c) + side.square * c);
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

// Number of sectors of a set.
AO_FN real ao_sectors_in(uint set)
{
    uint pairs = set - ((set >> 1) & uint(0x55555555u));
    uint fours = (pairs & uint(0x33333333u)) + ((pairs >> 2) & uint(0x33333333u));
    uint bytes = (fours + (fours >> 4)) & uint(0x0f0f0f0fu);
    return real(integer((bytes * uint(0x01010101u)) >> 24));
}
