// The list of cases for passes: every pair of options occurs in some case (all-pairs testing), among them every method,
// depth and normal format, projection convention, filter, size and kind of contents with every other.
#pragma once

#include "ao/conformance/pictures.hpp"
#include "ao/plan.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ao::conformance {

enum class contents { scene, noise, poisoned };

struct pass_case {
    std::string name;
    ao::settings settings;
    ao::facts facts;
    ao::camera camera;
    picture depth;
    picture normal; // empty where facts::normals is from_depth
};

struct depth_choice {
    std::string_view name;
    depth_source source;
    pixel_format format;
};
inline constexpr std::array<depth_choice, 6> depth_choices{ {
    { "linear r32f", depth_source::linear, pixel_format::r32f },
    { "hardware d32f", depth_source::hardware, pixel_format::d32f },
    { "hardware d24", depth_source::hardware, pixel_format::d24 },
    { "hardware r32f", depth_source::hardware, pixel_format::r32f },
    { "position rgba16f", depth_source::position, pixel_format::rgba16f },
    { "position rgba32f", depth_source::position, pixel_format::rgba32f },
} };

struct normal_choice {
    std::string_view name;
    normal_source source;
    pixel_format format;
};
inline constexpr std::array<normal_choice, 5> normal_choices{ {
    { "vector rgba16f", normal_source::vector, pixel_format::rgba16f },
    { "vector rgba32f", normal_source::vector, pixel_format::rgba32f },
    { "unorm10", normal_source::unorm10, pixel_format::rgb10a2 },
    { "octahedral", normal_source::octahedral, pixel_format::rg16 },
    { "from depth", normal_source::from_depth, pixel_format::rgba16f },
} };

inline constexpr std::array<std::pair<int, int>, 4> sizes{ { { 1, 1 }, { 1, 7 }, { 33, 17 }, { 64, 48 } } };

// One option each.
enum factor : std::size_t {
    of_depth,
    of_normals,
    of_size,
    of_filter,
    of_method,
    of_contents,
    of_taps,
    of_world_normals,
    of_parallel,
    of_range,
    of_reversed,
    of_y_down,
    of_rows,
    of_infinite,
    of_off_centre,
    of_thickness,
    of_output,
    of_background,
    factor_count,
};
inline constexpr std::array<std::uint32_t, factor_count> choices{ 6, 5, 4, 4, 5, 3, 3, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2 };
using choice = std::array<std::uint32_t, factor_count>;

namespace detail {

// Pairs of (factor, choice) not yet in any case.
class open_pairs {
public:
    open_pairs()
    {
        for (std::size_t f = 0; f < factor_count; ++f) {
            start_[f] = total_;
            total_ += choices[f];
        }
        open_.assign(total_ * total_, false);
        for (std::size_t f = 0; f < factor_count; ++f) {
            for (std::size_t g = f + 1; g < factor_count; ++g) {
                for (std::uint32_t i = 0; i < choices[f]; ++i) {
                    for (std::uint32_t j = 0; j < choices[g]; ++j) {
                        open_[(start_[f] + i) * total_ + start_[g] + j] = true;
                        ++left_;
                    }
                }
            }
        }
    }
    std::size_t left() const { return left_; }
    std::size_t count(const choice& c) const
    {
        std::size_t found = 0;
        for (std::size_t f = 0; f < factor_count; ++f) {
            for (std::size_t g = f + 1; g < factor_count; ++g) {
                found += open_[(start_[f] + c[f]) * total_ + start_[g] + c[g]] ? 1U : 0U;
            }
        }
        return found;
    }
    void close(const choice& c)
    {
        left_ -= count(c);
        for (std::size_t f = 0; f < factor_count; ++f) {
            for (std::size_t g = f + 1; g < factor_count; ++g) {
                open_[(start_[f] + c[f]) * total_ + start_[g] + c[g]] = false;
            }
        }
    }

private:
    std::array<std::size_t, factor_count> start_{};
    std::size_t total_ = 0;
    std::size_t left_ = 0;
    std::vector<bool> open_;
};

} // namespace detail

// All pairs of choices.
// Greedy: each case starts from a random draw and takes, option by option, the choice that closes most open pairs.
inline std::vector<choice> all_pairs()
{
    detail::open_pairs open;
    std::vector<choice> cases;
    random_stream random(7);
    while (open.left() > 0) {
        choice c{};
        for (std::size_t f = 0; f < factor_count; ++f) {
            c[f] = random.next() % choices[f];
        }
        for (int round = 0; round < 3; ++round) {
            for (std::size_t f = 0; f < factor_count; ++f) {
                choice best = c;
                for (std::uint32_t i = 0; i < choices[f]; ++i) {
                    choice tried = c;
                    tried[f] = i;
                    best = open.count(tried) > open.count(best) ? tried : best;
                }
                c = best;
            }
        }
        if (open.count(c) > 0) {
            open.close(c);
            cases.push_back(c);
        }
    }
    return cases;
}

inline camera_projection make_case_projection(const choice& c)
{
    projection_options options;
    options.range = c[of_range] == 0 ? depth_range::zero_to_one : depth_range::minus_one_to_one;
    options.rows = c[of_rows] == 0 ? first_row::at_ndc_minus_one : first_row::at_ndc_plus_one;
    options.reversed = c[of_reversed] != 0;
    options.y_down = c[of_y_down] != 0;
    options.parallel = c[of_parallel] != 0;
    const double extent = options.parallel ? 3.0 : 0.7;
    frustum f{ -extent, extent, -0.75 * extent, 0.75 * extent, 0.25, 60 };
    if (c[of_off_centre] != 0) {
        f.right *= 1.5;
        f.top *= 0.5;
    }
    if (c[of_infinite] != 0 && !options.parallel) {
        f.far = std::numeric_limits<double>::infinity();
    }
    return make_projection(f, options);
}

inline pass_case make_case(const choice& c)
{
    constexpr std::array<std::string_view, 5> methods{ "box", "hemisphere", "halton", "bitmask", "bitmask at half resolution" };
    constexpr std::array<std::string_view, 3> kinds{ "scene", "noise", "poisoned" };
    constexpr std::array<int, 3> taps{ 8, 32, 13 };
    constexpr std::array<int, 4> filters{ 1, 3, 5, 31 };
    pass_case made;
    const bool coarse = c[of_method] == 4;
    made.settings.method = coarse ? method::bitmask : static_cast<method>(c[of_method]);
    made.settings.resolution = coarse ? resolution::half : resolution::full;
    made.settings.taps = taps[c[of_taps]];
    if (made.settings.method == method::bitmask && made.settings.taps == 13) {
        made.settings.taps = 12;
        made.settings.slices = 3;
    }
    made.settings.radius = 0.8F;
    made.settings.filter = coarse ? std::max(filters[c[of_filter]], 3) : filters[c[of_filter]];
    made.settings.seed = 1 + c[of_method] + c[of_size];
    if (c[of_thickness] != 0) {
        made.settings.thickness = 0.9F;
    }
    made.facts.width = sizes[c[of_size]].first;
    made.facts.height = sizes[c[of_size]].second;
    made.facts.depth = depth_choices[c[of_depth]].source;
    made.facts.depth_format = depth_choices[c[of_depth]].format;
    made.facts.normals = normal_choices[c[of_normals]].source;
    made.facts.normal_format = normal_choices[c[of_normals]].format;
    made.facts.world_normals = c[of_world_normals] != 0;
    made.facts.parallel = c[of_parallel] != 0;
    made.facts.output_format = c[of_output] != 0 ? pixel_format::r8 : pixel_format::r32f;
    made.camera.projection = make_case_projection(c);
    if (c[of_background] != 0) {
        made.camera.background = 8.5F;
    }
    if (made.facts.world_normals) {
        // Columns (0.6, 0, -0.8), (0, 1, 0), (0.8, 0, 0.6): a turn about Y.
        made.camera.normal_to_view[0][0] = 0.6F;
        made.camera.normal_to_view[0][2] = -0.8F;
        made.camera.normal_to_view[2][0] = 0.8F;
        made.camera.normal_to_view[2][2] = 0.6F;
    }

    const auto kind = static_cast<contents>(c[of_contents]);
    const surfaces seen = kind == contents::noise || (kind == contents::poisoned && c[of_taps] == 0)
                              ? make_noise(made.facts.width, made.facts.height, made.settings.seed)
                              : make_scene(made.facts.width, made.facts.height, made.camera.projection);
    made.depth =
        pack_depth(seen.depth, seen.width, seen.height, made.facts.depth, made.facts.depth_format, made.camera.projection);
    if (made.facts.normals != normal_source::from_depth) {
        made.normal = pack_normals(seen.normals, seen.width, seen.height, made.facts.normals, made.facts.normal_format);
    }
    if (kind == contents::poisoned) {
        poison(made.depth, made.settings.seed);
        poison(made.normal, made.settings.seed + 1);
    }

    const auto text = [](auto value) { return std::to_string(value); };
    const auto option = [&](factor f, std::string_view name) { return c[f] != 0 ? ", " + std::string(name) : std::string(); };
    made.name = std::string(methods[c[of_method]]) + " " + text(made.settings.taps) + " taps, " + text(made.facts.width) + "x" +
                text(made.facts.height) + " " + std::string(kinds[c[of_contents]]) + ", depth " +
                std::string(depth_choices[c[of_depth]].name) + ", normals " + std::string(normal_choices[c[of_normals]].name) +
                ", filter " + text(made.settings.filter) + option(of_parallel, "parallel") + option(of_range, "z -1..1") +
                option(of_reversed, "reversed") + option(of_y_down, "y down") + option(of_rows, "rows from +1") +
                option(of_infinite, "infinite far") + option(of_off_centre, "off-centre") +
                option(of_world_normals, "world normals") + option(of_thickness, "thickness") +
                option(of_background, "background 8.5") + option(of_output, "to r8");
    return made;
}

} // namespace ao::conformance
