#include "host/vulkan_device.hpp"
#include "host/vulkan_timer.hpp"
#include "support/pixel_patterns.hpp"

#include <catch2/catch.hpp>

using namespace ao;
using namespace ao::host;
using Catch::Matchers::Contains;

TEST_CASE("the default Vulkan device is the CPU")
{
    auto device = vulkan_device::create();
    REQUIRE(device);
    CHECK((*device)->properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU);
    CHECK((*device)->messages().empty());
}

TEST_CASE("a Vulkan device is found by part of its name, in any case")
{
    auto device = vulkan_device::create({ "LLVMpipe", false });
    REQUIRE(device);
    CHECK_THAT(std::string((*device)->name()), Contains("llvmpipe"));
}

TEST_CASE("an unknown Vulkan device is refused with the names there are")
{
    const auto device = vulkan_device::create({ "no such card", false });
    REQUIRE_FALSE(device);
    CHECK_THAT(device.reason(), Contains("no Vulkan device named \"no such card\"") && Contains("llvmpipe"));
    CHECK(device.reason().find('\n') == std::string::npos);
    const auto names = vulkan_device_names();
    REQUIRE(names);
    CHECK_FALSE((*names).empty());
}

TEST_CASE("Vulkan images return the bits they were given, validation clean")
{
    auto device = vulkan_device::create({ "", true });
    REQUIRE(device);
    for (const pixel_format format : all_pixel_formats)
        for (const extent size : { extent{ 1, 1 }, extent{ 1, 9 }, extent{ 7, 5 }, extent{ 64, 33 } }) {
            INFO(name(format) << " " << size.width << "x" << size.height);
            auto image = vulkan_image::create(**device, format, size);
            REQUIRE(image);
            const auto pixels = pixel_pattern(format, size);
            std::vector<std::byte> back(pixels.size());
            REQUIRE(image->upload(pixels));
            CHECK(image->layout == VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
            REQUIRE(image->download(back));
            CHECK(back == pixels);
            REQUIRE(image->transition(VK_IMAGE_LAYOUT_GENERAL));
            std::fill(back.begin(), back.end(), std::byte{ 0 });
            REQUIRE(image->download(back));
            CHECK(back == pixels);
        }
    CHECK_THAT((*device)->messages(), Catch::Matchers::Equals(std::vector<std::string>{}));
}

TEST_CASE("Vulkan images of impossible sizes are refused")
{
    auto device = vulkan_device::create({ "", true });
    REQUIRE(device);
    const auto empty = vulkan_image::create(**device, pixel_format::r32f, { 0, 5 });
    REQUIRE_FALSE(empty);
    CHECK_THAT(empty.reason(), Contains("no pixels"));
    const auto huge = vulkan_image::create(**device, pixel_format::r32f, { 1u << 20, 1 });
    REQUIRE_FALSE(huge);
    CHECK_THAT(huge.reason(), Contains("exceeds the limit"));
    auto image = vulkan_image::create(**device, pixel_format::r32f, { 4, 4 });
    REQUIRE(image);
    CHECK_FALSE(image->upload(std::vector<std::byte>(3)));
    std::vector<std::byte> pixels(64);
    const auto unwritten = image->download(pixels);
    REQUIRE_FALSE(unwritten);
    CHECK_THAT(unwritten.reason(), Contains("never written"));
    CHECK((*device)->messages().empty());
}

TEST_CASE("the validation layer catches a planted misuse")
{
    auto device = vulkan_device::create({ "", true });
    REQUIRE(device);
    auto image = vulkan_image::create(**device, pixel_format::r32f, { 4, 4 });
    REQUIRE(image);
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image->image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = image->vk_format;
    info.subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 7, 1, 0, 1 }; // there is one level
    VkImageView view = VK_NULL_HANDLE;
    vkCreateImageView((*device)->device, &info, nullptr, &view);
    CHECK_FALSE((*device)->messages().empty());
    vkDestroyImageView((*device)->device, view, nullptr);
}

TEST_CASE("synchronisation validation catches a missing barrier")
{
    auto device = vulkan_device::create({ "", true });
    REQUIRE(device);
    auto buffer = vulkan_buffer::create(**device, 256, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    auto other = vulkan_buffer::create(**device, 256, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    REQUIRE(buffer);
    REQUIRE(other);
    const auto copied = (*device)->submit([&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffer->buffer, 0, 256, 1u);
        const VkBufferCopy whole{ 0, 0, 256 };
        vkCmdCopyBuffer(commands, buffer->buffer, other->buffer, 1, &whole);
    });
    REQUIRE(copied);
    const auto messages = (*device)->messages();
    REQUIRE_FALSE(messages.empty());
    CHECK_THAT(messages.front(), Contains("SYNC-HAZARD-READ-AFTER-WRITE") || Contains("SYNC-HAZARD-READ_AFTER_WRITE"));
}

TEST_CASE("a timer measures the stretches between its marks")
{
    auto device = vulkan_device::create({ "", true });
    REQUIRE(device);
    auto timer = vulkan_timer::create(**device, 3);
    REQUIRE(timer);
    auto buffer = vulkan_buffer::create(**device, 1u << 20, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    REQUIRE(buffer);
    REQUIRE((*device)->submit([&](VkCommandBuffer commands) {
        timer->record_reset(commands);
        timer->record_mark(commands);
        vkCmdFillBuffer(commands, buffer->buffer, 0, 1u << 20, 1u);
        timer->record_mark(commands);
        timer->record_mark(commands);
    }));
    const auto times = timer->read();
    REQUIRE(times);
    REQUIRE((*times).size() == 2);
    CHECK((*times)[0] > 0);
    CHECK((*times)[0] < 10000);
    CHECK((*times)[1] >= 0);
    CHECK((*device)->messages().empty());
}
