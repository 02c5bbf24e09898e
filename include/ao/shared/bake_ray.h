// Whether a triangle stands in the way of a ray: the predicate of ambient occlusion per vertex, the same bits on every route and
// backend. Every point is seen along a line of directions d and -d: (u, w) across it in whole steps of a lattice, and its depth.
// Differences of lattice numbers are exact, and so is the side of every edge that a start lies on; the rounded mesh has no gaps
// that the mesh does not have, at edges and corners either. Exactness: E, but for ao_bake_distance (Q).
// Points lie in a ball of radius 15/16 about the origin, starts within 2^-12 of it.

AO_CONST real ao_bake_lattice = real(8388608); // steps per unit: differences stay below 2^24

struct ao_bake_line {
    real ux; // u, w, d: unit vectors, u x w = d
    real uy;
    real uz;
    real wx;
    real wy;
    real wz;
    real dx;
    real dy;
    real dz;
    real weight;   // of each direction, an even whole number (ao_bake_weight_one)
    real opposite; // 1 where -d is a direction of the rule as well, else 0
    real reserved;
};

// The rule turned for one vertex.
AO_FN ao_bake_line ao_bake_turned(ao_rotation turn, ao_bake_line line)
{
    vec3 u = ao_rotate(turn, vec3(line.ux, line.uy, line.uz));
    vec3 w = ao_rotate(turn, vec3(line.wx, line.wy, line.wz));
    vec3 d = ao_rotate(turn, vec3(line.dx, line.dy, line.dz));
    ao_bake_line turned = { u.x, u.y, u.z, w.x, w.y, w.z, d.x, d.y, d.z, line.weight, line.opposite, line.reserved };
    return turned;
}

struct ao_bake_point {
    real u; // whole steps
    real w;
    real d; // depth along the line, units
};

AO_FN real ao_bake_step(real x)
{
    AO_PRECISE real steps = x * ao_bake_lattice + real(0.5);
    return floor(steps);
}

AO_FN ao_bake_point ao_bake_seen(ao_bake_line line, vec3 p)
{
    AO_PRECISE real u = p.x * line.ux + p.y * line.uy + p.z * line.uz;
    AO_PRECISE real w = p.x * line.wx + p.y * line.wy + p.z * line.wz;
    AO_PRECISE real d = p.x * line.dx + p.y * line.dy + p.z * line.dz;
    ao_bake_point seen = { ao_bake_step(u), ao_bake_step(w), d };
    return seen;
}

// p x q of whole numbers below 2^24: exact in sign, and exact where the rounded products are equal. Rounding keeps order, so
// that unequal rounded products decide; equal ones differ by one unit of their last place at most, 2^24, which 32 bits hold.
AO_FN real ao_bake_edge(real pu, real pw, real qu, real qw)
{
    AO_PRECISE real a = pu * qw;
    AO_PRECISE real b = pw * qu;
    AO_PRECISE real e = a - b;
    mask undecided = a == b;
    if (ao_any(undecided)) {
        uint difference = uint(integer(pu)) * uint(integer(qw)) - uint(integer(pw)) * uint(integer(qu));
        e = mix(e, real(integer(difference)), undecided);
    }
    return e;
}

// Where the line through a start meets a triangle: at depth moment / area from the start, if `inside`. Edges and corners belong
// to the triangle; triangles seen edge-on have no inside, their neighbours have it.
struct ao_bake_crossing {
    real area; // twice, in square steps, >= 0
    real moment;
    mask turned; // the corners are seen clockwise along -d
    mask inside;
};

AO_FN ao_bake_crossing ao_bake_crossing_of(ao_bake_point s, ao_bake_point a, ao_bake_point b, ao_bake_point c)
{
    AO_PRECISE real au = a.u - s.u;
    AO_PRECISE real aw = a.w - s.w;
    AO_PRECISE real bu = b.u - s.u;
    AO_PRECISE real bw = b.w - s.w;
    AO_PRECISE real cu = c.u - s.u;
    AO_PRECISE real cw = c.w - s.w;
    real bc = ao_bake_edge(bu, bw, cu, cw);
    real ca = ao_bake_edge(cu, cw, au, aw);
    real ab = ao_bake_edge(au, aw, bu, bw);
    AO_PRECISE real area = bc + ca + ab;
    AO_PRECISE real ad = a.d - s.d;
    AO_PRECISE real bd = b.d - s.d;
    AO_PRECISE real cd = c.d - s.d;
    AO_PRECISE real moment = bc * ad + ca * bd + ab * cd;
    mask left = bc >= real(0) && ca >= real(0) && ab >= real(0);
    mask right = bc <= real(0) && ca <= real(0) && ab <= real(0);
    mask turned = area < real(0);
    ao_bake_crossing crossing = { abs(area), mix(moment, -moment, turned), turned,
                                  (left || right) && (area > real(0) || turned) };
    return crossing;
}

// Whether it lies ahead of the start, along d, by `reach` at most.
AO_FN mask ao_bake_ahead(ao_bake_crossing crossing, real reach)
{
    AO_PRECISE real most = crossing.area * reach;
    mask ahead = crossing.inside && crossing.moment > real(0) && crossing.moment <= most;
    return ahead;
}

// The same along -d.
AO_FN mask ao_bake_behind(ao_bake_crossing crossing, real reach)
{
    AO_PRECISE real most = crossing.area * reach;
    AO_PRECISE real moment = -crossing.moment;
    mask behind = crossing.inside && moment > real(0) && moment <= most;
    return behind;
}

// Precondition: ahead or behind; elsewhere of no use.
AO_FN real ao_bake_distance(ao_bake_crossing crossing)
{
    AO_PRECISE real distance = abs(crossing.moment) / mix(real(1), crossing.area, crossing.area > real(0));
    return distance;
}
