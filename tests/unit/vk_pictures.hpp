// Host images of a test, and the validated device they live on.
#pragma once

#include "ao/picture.hpp"
#include "support/vk_runner.hpp"
#include "unit/picture_test.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

namespace vk_test {

using picture_test::differing;

// With the validation layer and synchronisation validation.
inline ao::host::vulkan_device& device()
{
    static auto made = ao::host::vulkan_device::create({ "", true });
    REQUIRE(made);
    return **made;
}

inline void check_silence(const ao::host::vulkan_device& of = device())
{
    CHECK_THAT(of.messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}

// Its content is undefined.
inline ao::host::vulkan_image make_image(ao::pixel_format format, int width, int height, VkImageLayout layout,
                                         ao::host::vulkan_device& on = device())
{
    auto made = ao::host::vulkan_image::create(on, format, { static_cast<unsigned>(width), static_cast<unsigned>(height) });
    REQUIRE(made);
    REQUIRE(made->transition(layout));
    return std::move(*made);
}

inline ao::host::vulkan_image upload(const ao::picture& from)
{
    return vk_runner::upload(device(), from, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

inline ao::picture download(ao::host::vulkan_image& from)
{
    ao::picture to(from.format, static_cast<int>(from.size.width), static_cast<int>(from.size.height));
    REQUIRE(from.download(to.bytes));
    return to;
}

inline ao::vk::image handle(const ao::host::vulkan_image& of)
{
    return { of.view, of.layout };
}

} // namespace vk_test
