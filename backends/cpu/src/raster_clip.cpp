#include "raster_clip.hpp"

namespace ao::cpu {

namespace {

struct polygon {
    std::array<glm::dvec4, 9> corners;
    std::size_t count = 0;

    void add(const glm::dvec4& p) { corners[count++] = p; }
};

// From the inner end, so that the edge's direction does not matter.
glm::dvec4 cut(const glm::dvec4& inner, double inside, const glm::dvec4& outer, double outside)
{
    const double t = inside / (inside - outside);
    return { inner.x + (outer.x - inner.x) * t, inner.y + (outer.y - inner.y) * t, inner.z + (outer.z - inner.z) * t,
             inner.w + (outer.w - inner.w) * t };
}

// Keeps where `distance` is not negative.
template <class Distance>
polygon clip(const polygon& from, Distance distance)
{
    polygon kept;
    for (std::size_t i = 0; i < from.count; ++i) {
        const glm::dvec4& a = from.corners[i];
        const glm::dvec4& b = from.corners[i + 1 < from.count ? i + 1 : 0];
        const double at_a = distance(a);
        const double at_b = distance(b);
        if (at_a >= 0) {
            kept.add(a);
        }
        if (at_a >= 0 && at_b < 0) {
            kept.add(cut(a, at_a, b, at_b));
        }
        else if (at_a < 0 && at_b >= 0) {
            kept.add(cut(b, at_b, a, at_a));
        }
        if (kept.count == kept.corners.size()) {
            break; // rounding made it concave
        }
    }
    return kept;
}

} // namespace

clipped_polygon clip_triangle(const raster_view& v, const std::array<glm::vec4, 3>& corners)
{
    polygon p;
    for (const glm::vec4& c : corners) {
        p.add(glm::dvec4(c));
    }
    if (v.zero_to_one) {
        p = clip(p, [](const glm::dvec4& c) { return c.z; });
    }
    else {
        p = clip(p, [](const glm::dvec4& c) { return c.z + c.w; });
    }
    p = clip(p, [](const glm::dvec4& c) { return c.w - c.z; });
    p = clip(p, [&](const glm::dvec4& c) { return v.guard_x * c.w - c.x; });
    p = clip(p, [&](const glm::dvec4& c) { return v.guard_x * c.w + c.x; });
    p = clip(p, [&](const glm::dvec4& c) { return v.guard_y * c.w - c.y; });
    p = clip(p, [&](const glm::dvec4& c) { return v.guard_y * c.w + c.y; });
    clipped_polygon clipped;
    for (std::size_t i = 0; i < p.count; ++i) {
        const glm::vec4 c(p.corners[i]);
        if (!(c.w >= least_w)) {
            return {};
        }
        clipped.corners[i] = c;
    }
    clipped.count = p.count;
    return clipped;
}

} // namespace ao::cpu
