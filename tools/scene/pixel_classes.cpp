#include "pixel_classes.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace ao::tools {
namespace {

class picture_view {
public:
    picture_view(const gbuffer& g, const class_settings& s) : g_(g), s_(s) {}

    [[nodiscard]] std::size_t at(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(g_.width) + static_cast<std::size_t>(x);
    }
    // Surfaces that do not go on from one pixel to the next; one is much nearer, or there is none beside it.
    [[nodiscard]] bool jump(std::size_t a, std::size_t b) const
    {
        if (g_.hit[a] != g_.hit[b])
            return true;
        if (g_.hit[a] == 0)
            return false;
        const glm::vec3 apart = g_.position[b] - g_.position[a];
        const float from_a = std::abs(glm::dot(apart, g_.geometric_normal[a]));
        const float from_b = std::abs(glm::dot(apart, g_.geometric_normal[b]));
        return std::min(from_a, from_b) > jump_share * s_.radius;
    }
    // Whether a is in front of b where they jump.
    [[nodiscard]] bool in_front(std::size_t a, std::size_t b) const
    {
        return g_.hit[a] != 0 && (g_.hit[b] == 0 || g_.depth[a] < g_.depth[b]);
    }
    [[nodiscard]] float reach(std::size_t i) const { return s_.radius * scale(i); }
    // Pixels that something so narrow covers at most.
    [[nodiscard]] int thin_pixels(std::size_t i) const
    {
        const float most = thin_share * s_.radius * scale(i);
        return most < static_cast<float>(thinnest_kernel) ? static_cast<int>(most) : thinnest_kernel;
    }

private:
    [[nodiscard]] float scale(std::size_t i) const { return s_.orthographic ? s_.focal : s_.focal / g_.depth[i]; }

    const gbuffer& g_;
    const class_settings& s_;
};

std::vector<std::uint8_t> find_jumps(const picture_view& v, int width, int height)
{
    std::vector<std::uint8_t> jumps(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    const auto mark = [&](std::size_t a, std::size_t b) {
        if (v.jump(a, b))
            jumps[a] = jumps[b] = 1;
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (x > 0)
                mark(v.at(x - 1, y), v.at(x, y));
            if (y > 0)
                mark(v.at(x, y - 1), v.at(x, y));
        }
    return jumps;
}

// Runs along one row or column: `place(i)` is its pixel i of `length`.
template <class Place>
void find_thin(const picture_view& v, std::vector<std::uint8_t>& thin, int length, Place&& place)
{
    int start = 0; // of the run since the last jump, in front of what was before it
    bool front = false;
    for (int i = 1; i < length; ++i) {
        const std::size_t before = place(i - 1);
        const std::size_t here = place(i);
        if (!v.jump(before, here))
            continue;
        if (front && v.in_front(before, here) && i - start <= std::max(1, v.thin_pixels(place(start))))
            for (int j = start; j < i; ++j)
                thin[place(j)] = 1;
        front = v.in_front(here, before);
        start = i;
    }
}

// Within near_jump pixels of a mark, in a square.
std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& marks, int width, int height)
{
    const auto pass = [&](const std::vector<std::uint8_t>& from, int length, int lines, std::size_t step, std::size_t line_step) {
        std::vector<std::uint8_t> to(from.size(), 0);
        for (int line = 0; line < lines; ++line) {
            const std::size_t first = static_cast<std::size_t>(line) * line_step;
            int last = -near_jump - 1;
            const auto sweep = [&](int i) {
                const std::size_t at = first + static_cast<std::size_t>(i) * step;
                if (from[at] != 0)
                    last = i;
                if (std::abs(i - last) <= near_jump)
                    to[at] = 1;
            };
            for (int i = 0; i < length; ++i)
                sweep(i);
            last = length + near_jump + 1;
            for (int i = length - 1; i >= 0; --i)
                sweep(i);
        }
        return to;
    };
    const auto row = static_cast<std::size_t>(width);
    return pass(pass(marks, width, height, 1, row), height, width, row, 1);
}

} // namespace

const char* name_of(pixel_class c)
{
    switch (c) {
    case pixel_class::background:
        return "background";
    case pixel_class::interior:
        return "interior";
    case pixel_class::silhouette:
        return "silhouette";
    case pixel_class::border:
        return "border";
    case pixel_class::disoccluded:
        return "disoccluded";
    case pixel_class::thin:
        return "thin";
    }
    return "unknown";
}

float focal_of(const frustum& f, int width)
{
    return static_cast<float>(width) / (f.right - f.left);
}

std::vector<pixel_class> classify(const gbuffer& g, const class_settings& s)
{
    const picture_view v(g, s);
    const std::vector<std::uint8_t> jumps = find_jumps(v, g.width, g.height);
    std::vector<std::uint8_t> thin(g.size(), 0);
    for (int y = 0; y < g.height; ++y)
        find_thin(v, thin, g.width, [&](int i) { return v.at(i, y); });
    for (int x = 0; x < g.width; ++x)
        find_thin(v, thin, g.height, [&](int i) { return v.at(x, i); });
    const std::vector<std::uint8_t> near_silhouette = widened(jumps, g.width, g.height);
    const std::vector<std::uint8_t> near_thin = widened(thin, g.width, g.height);

    std::vector<pixel_class> classes(g.size(), pixel_class::background);
    for (int y = 0; y < g.height; ++y)
        for (int x = 0; x < g.width; ++x) {
            const std::size_t i = v.at(x, y);
            if (g.hit[i] == 0)
                continue;
            const int inside = std::min(std::min(x, g.width - 1 - x), std::min(y, g.height - 1 - y));
            classes[i] = static_cast<float>(inside) < v.reach(i) ? pixel_class::border
                         : near_thin[i] != 0                     ? pixel_class::thin
                         : near_silhouette[i] != 0               ? pixel_class::silhouette
                                                                 : pixel_class::interior;
        }
    return classes;
}

std::size_t count_jumps(const gbuffer& g, const class_settings& s)
{
    const std::vector<std::uint8_t> jumps = find_jumps(picture_view(g, s), g.width, g.height);
    return static_cast<std::size_t>(std::count(jumps.begin(), jumps.end(), std::uint8_t{ 1 }));
}

void mark_disoccluded(std::vector<pixel_class>& classes, const gbuffer& before, const std::vector<pixel_motion>& motion)
{
    for (std::size_t i = 0; i < classes.size(); ++i) {
        if (classes[i] == pixel_class::background)
            continue;
        const float x = std::floor(static_cast<float>(i % static_cast<std::size_t>(before.width)) + 0.5f + motion[i].x);
        const float y = std::floor(static_cast<float>(i / static_cast<std::size_t>(before.width)) + 0.5f + motion[i].y);
        bool seen = motion[i].depth > 0.0f && x >= 0.0f && y >= 0.0f && x < static_cast<float>(before.width) &&
                    y < static_cast<float>(before.height);
        if (seen) {
            // Half a pixel of a steep surface is within the same share of depth that the default of the effect allows twice over.
            constexpr float share = 0.02f;
            const auto was = static_cast<std::size_t>(y) * static_cast<std::size_t>(before.width) + static_cast<std::size_t>(x);
            seen = before.hit[was] != 0 && before.depth[was] > motion[i].depth * (1.0f - share);
        }
        if (!seen)
            classes[i] = pixel_class::disoccluded;
    }
}

std::array<std::size_t, pixel_class_count> count_classes(const std::vector<pixel_class>& classes)
{
    std::array<std::size_t, pixel_class_count> counts{};
    for (const pixel_class c : classes)
        ++counts[static_cast<std::size_t>(c)];
    return counts;
}

} // namespace ao::tools
