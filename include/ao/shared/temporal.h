// Rules of temporal ambient occlusion (paper 2; Mattausch, Scherzer, Wimmer, "Temporal Screen-Space Ambient Occlusion", 2010):
// when a history has converged, when it is wrong, what a new frame adds to it. `weight` counts the samples that a value stands
// for.

// The rows of an affine map as reals: GLM's vectors cannot be made from bytes in constant expressions.
struct ao_affine_reals {
    real xx;
    real xy;
    real xz;
    real x;
    real yx;
    real yy;
    real yz;
    real y;
    real zx;
    real zy;
    real zz;
    real z;
};

AO_FN ao_affine_map ao_affine_of(ao_affine_reals m)
{
    ao_affine_map map = { vec4(m.xx, m.xy, m.xz, m.x), vec4(m.yx, m.yy, m.yz, m.y), vec4(m.zx, m.zy, m.zz, m.z) };
    return map;
}

// Samples of a pixel so far as a share of what it may have: conv = w / w_max.
AO_FN real ao_convergence(real weight, real most)
{
    AO_PRECISE real share = weight / most;
    return share;
}

// (4): the mean of `weight` samples of mean `value` and `count` new ones that add up to `sum`. Precondition: weight + count > 0.
AO_FN real ao_accumulated(real value, real weight, real sum, real count)
{
    AO_PRECISE real mean = (weight * value + sum) / (weight + count);
    return mean;
}

// (5): w = min(w + k, w_max).
AO_FN real ao_next_weight(real weight, real count, real most)
{
    AO_PRECISE real next = weight + count;
    return min(next, most);
}

// The sample that the next frame begins with. The sequence starts again after `period` samples; count <= period.
AO_FN real ao_next_index(real index, real count, real period)
{
    AO_PRECISE real next = index + count;
    AO_PRECISE real wrapped = next - period;
    return mix(next, wrapped, next >= period);
}

// How far the depth that a history holds may lie from the one expected, scene units: a share of the depth itself, what its
// storage rounds (constant + d * (linear + d * quadratic), ao/plan.hpp), and what the surface's slope makes of the distance
// between pixel centres. `slope`: change of depth per pixel.
AO_FN real ao_depth_tolerance(real d, real share, real constant, real linear, real quadratic, real slope)
{
    AO_PRECISE real tolerance = constant + d * (share + linear + d * quadratic) + slope;
    return tolerance;
}

// (7): |1 - d_f / d_{f-1}| < eps, as a difference. False for NaN and for a history without a surface.
AO_FN mask ao_same_surface(real expected, real stored, real tolerance)
{
    AO_PRECISE real apart = abs(stored - expected);
    mask same = apart <= tolerance && stored > real(0);
    return same;
}

// conf = 1 / (1 + S delta / R), with `steepness` S / R and `change` delta = | |s - p| - |s_{f-1} - p_{f-1}| |.
AO_FN real ao_confidence(real change, real steepness)
{
    AO_PRECISE real confidence = real(1) / (real(1) + steepness * change);
    return confidence;
}

// Weights stay whole numbers.
AO_FN real ao_kept_weight(real weight, real confidence)
{
    AO_PRECISE real kept = weight * confidence;
    return floor(kept);
}

// (11) s(p) = max(c - conv, 0) / c, with c = c_spatial, 0 where c is 0.
AO_FN real ao_filter_support(real convergence, real c)
{
    mask any = c > real(0);
    AO_PRECISE real support = max(c - convergence, real(0)) / mix(real(1), c, any);
    return mix(real(0), support, any);
}

// (10) g: falls smoothly from 1 to 0 where the squared world distance reaches the squared support; 1 at distance 0 even if that
// is 0.
AO_FN real ao_filter_weight(real squared_distance, real squared_support)
{
    mask any = squared_support > real(0);
    AO_PRECISE real t = squared_distance / mix(real(1), squared_support, any);
    AO_PRECISE real lobe = max(real(1) - t, real(0));
    AO_PRECISE real weight = lobe * lobe;
    mask own = squared_distance <= real(0);
    return mix(mix(real(0), weight, any), real(1), own);
}

// Weights of texels -1, 0, 1 and 2 at fraction f = 0 ... 1 between texels 0 and 1: Catmull and Rom, 1974. Their second moment is
// that of the position itself, so that a history fetched again and again between pixels does not spread as one does by bilinear
// weights.
AO_FN vec4 ao_cubic_weights(real f)
{
    AO_PRECISE vec4 weights =
        vec4(f * (real(-0.5) + f * (real(1) - real(0.5) * f)), real(1) + f * f * (real(-2.5) + real(1.5) * f),
             f * (real(0.5) + f * (real(2) - real(1.5) * f)), f * f * (real(-0.5) + real(0.5) * f));
    return weights;
}
