// The reference executor over one faulty copy of the shared source, in a namespace of its own: `ao` is defined as its name when
// this is compiled, and the copy's directory comes first on the include path.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#define ao AO_PLANTED_NAMESPACE
#include "ao/conformance/reference.hpp"

namespace AO_PLANTED_NAMESPACE {

std::vector<float> planted_frame(const void* of_settings, const void* of_facts, const void* of_camera,
                                 const std::vector<std::byte>& of_depth, const std::vector<std::byte>& of_normal);

std::vector<float> planted_frame(const void* of_settings, const void* of_facts, const void* of_camera,
                                 const std::vector<std::byte>& of_depth, const std::vector<std::byte>& of_normal)
{
    settings s;
    facts f;
    camera view;
    std::memcpy(&s, of_settings, sizeof s);
    std::memcpy(&f, of_facts, sizeof f);
    std::memcpy(&view, of_camera, sizeof view);
    picture depth(f.depth_format, f.width, f.height);
    depth.bytes = of_depth;
    picture normal;
    if (f.normals != normal_source::from_depth) {
        normal = picture(f.normal_format, f.width, f.height);
        normal.bytes = of_normal;
    }
    const auto planned = make_plan(s, f, view);
    std::vector<float> seen;
    if (planned) {
        conformance::executor<float> run(*planned, depth, normal);
        for (const auto& texel : run.run().texels) {
            seen.push_back(texel.x);
        }
    }
    return seen;
}

} // namespace AO_PLANTED_NAMESPACE
