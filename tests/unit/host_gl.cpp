#include "host/gl_texture.hpp"
#include "host/vulkan_device.hpp"
#include "support/pixel_patterns.hpp"

#include <catch2/catch.hpp>

using namespace ao;
using namespace ao::host;
using Catch::Matchers::Contains;

TEST_CASE("an OSMesa context is OpenGL 4.5 and names itself")
{
    auto context = gl_context::create();
    REQUIRE(context);
    CHECK_THAT((*context)->renderer, Contains("llvmpipe"));
    CHECK_THAT((*context)->version, Contains("Mesa"));
    CHECK_FALSE((*context)->vendor.empty());
    CHECK((*context)->loader()("glDispatchCompute") != nullptr);
}

TEST_CASE("an unknown GL device is refused with the names there are")
{
    const auto context = gl_context::create({ gl_platform::osmesa, "no such card" });
    REQUIRE_FALSE(context);
    CHECK_THAT(context.reason(), Contains("no GL device named \"no such card\"") && Contains("llvmpipe"));
    const auto egl = gl_context::create({ gl_platform::egl, "no such card" });
    REQUIRE_FALSE(egl);
    CHECK_THAT(egl.reason(), Contains("GL"));
    CHECK(egl.reason().find('\n') == std::string::npos);
}

TEST_CASE("EGL gives a context where it can and a reason where not")
{
    auto context = gl_context::create({ gl_platform::egl, "" });
    if (!context) {
        CHECK_THAT(context.reason(), Contains("no GL context"));
        return;
    }
    auto texture = gl_texture::create(**context, pixel_format::r32f, { 3, 2 });
    REQUIRE(texture);
    const auto pixels = pixel_pattern(pixel_format::r32f, { 3, 2 });
    auto back = pixels;
    REQUIRE(texture->upload(pixels));
    std::fill(back.begin(), back.end(), std::byte{ 0 });
    REQUIRE(texture->download(back));
    CHECK(back == pixels);
}

TEST_CASE("GL textures return the bits they were given")
{
    auto context = gl_context::create();
    REQUIRE(context);
    for (const pixel_format format : all_pixel_formats)
        for (const extent size : { extent{ 1, 1 }, extent{ 1, 9 }, extent{ 7, 5 }, extent{ 64, 33 } }) {
            INFO(name(format) << " " << size.width << "x" << size.height);
            auto texture = gl_texture::create(**context, format, size);
            REQUIRE(texture);
            const auto pixels = pixel_pattern(format, size);
            std::vector<std::byte> back(pixels.size());
            REQUIRE(texture->upload(pixels));
            REQUIRE(texture->download(back));
            CHECK(back == pixels);
        }
}

TEST_CASE("GL textures of impossible sizes are refused")
{
    auto context = gl_context::create();
    REQUIRE(context);
    const auto empty = gl_texture::create(**context, pixel_format::r32f, { 0, 5 });
    REQUIRE_FALSE(empty);
    CHECK_THAT(empty.reason(), Contains("no pixels"));
    const auto huge = gl_texture::create(**context, pixel_format::r32f, { 1u << 20, 1 });
    REQUIRE_FALSE(huge);
    CHECK_THAT(huge.reason(), Contains("exceeds the limit"));
    auto texture = gl_texture::create(**context, pixel_format::r32f, { 4, 4 });
    REQUIRE(texture);
    CHECK_FALSE(texture->upload(std::vector<std::byte>(3)));
}

TEST_CASE("OSMesa and lavapipe live in one process, in both orders")
{
    for (const bool vulkan_first : { false, true }) {
        auto early = vulkan_first ? vulkan_device::create() : failure{ "later" };
        auto context = gl_context::create();
        auto late = vulkan_first ? failure{ "earlier" } : vulkan_device::create();
        auto& device = vulkan_first ? early : late;
        REQUIRE(context);
        REQUIRE(device);
        auto texture = gl_texture::create(**context, pixel_format::rgba32f, { 5, 3 });
        auto image = vulkan_image::create(**device, pixel_format::rgba32f, { 5, 3 });
        REQUIRE(texture);
        REQUIRE(image);
        const auto pixels = pixel_pattern(pixel_format::rgba32f, { 5, 3 });
        std::vector<std::byte> from_gl(pixels.size());
        std::vector<std::byte> from_vulkan(pixels.size());
        REQUIRE(texture->upload(pixels));
        REQUIRE(image->upload(pixels));
        REQUIRE(texture->download(from_gl));
        REQUIRE(image->download(from_vulkan));
        CHECK(from_gl == pixels);
        CHECK(from_vulkan == pixels);
    }
}
