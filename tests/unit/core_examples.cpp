// The README's examples, run: a wall in front of a plane must darken it beside the wall, the same on every backend.
#include "ao/cpu/temporal.hpp"
#include "ao/gl/backend.hpp"
#include "ao/vk/backend.hpp"
#include "host/gl_texture.hpp"
#include "host/vulkan_device.hpp"

#include "ao/gbuffer.hpp"
#include "ao/picture.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

std::optional<ao::error> run_cpu(const ao::picture&, const ao::picture&, ao::picture&, const std::function<bool(ao::camera&)>&);
std::optional<ao::error> run_gl(ao::gl::backend::get_proc_address, const ao::host_images<unsigned>&, int, int,
                                const std::function<bool(ao::camera&)>&);
std::optional<ao::error> run_vk(const ao::vk::context&, const ao::host_images<ao::vk::image>&, int, int,
                                const std::function<VkCommandBuffer(ao::camera&)>&);
std::optional<ao::error> draw_scene(const ao::scene&, const ao::gbuffer_camera&, ao::picture&);
std::optional<ao::error> run_temporal(const ao::picture&, const ao::picture&, const ao::picture&, ao::picture&,
                                      const std::function<bool(ao::temporal_camera&, bool&)>&);

namespace {

constexpr int width = 64;
constexpr int height = 36;

// A plane at 5 with a block standing out to 4.4 in the middle; the camera of the example.
struct input {
    ao::picture depth;
    ao::picture normals;

    input(ao::depth_source source, ao::pixel_format format, const ao::camera_projection& projection)
    {
        std::vector<float> eye(static_cast<std::size_t>(width * height), 5.0F);
        for (int y = 12; y < 24; ++y) {
            for (int x = 24; x < 40; ++x) {
                eye[static_cast<std::size_t>(y * width + x)] = 4.4F;
            }
        }
        const std::vector<glm::vec3> towards_eye(eye.size(), glm::vec3(0, 0, 1));
        depth = ao::pack_depth(eye, width, height, source, format, projection);
        normals = ao::pack_normals(towards_eye, width, height, ao::normal_source::vector, ao::pixel_format::rgba16f);
    }
};

void check(const ao::picture& visibility)
{
    const auto at = [&](int x, int y) { return visibility.texel<float>(static_cast<std::size_t>(y * width + x)); };
    CHECK(at(2, 2) == 1.0F);
    CHECK(at(32, 18) > 0.9F);
    CHECK(at(22, 18) < 0.95F);
    CHECK(at(22, 18) >= 0.0F);
}

std::function<bool(ao::camera&)> two_frames()
{
    return [left = 2](ao::camera&) mutable { return left-- > 0; };
}

} // namespace

TEST_CASE("README, cpu", "[examples]")
{
    const input in(ao::depth_source::linear, ao::pixel_format::r32f,
                   ao::make_projection({ -1.0, 1.0, -0.5625, 0.5625, 0.1, 100.0 }));
    ao::picture visibility(ao::pixel_format::r32f, width, height);
    const auto wrong = run_cpu(in.depth, in.normals, visibility, two_frames());
    REQUIRE_FALSE(wrong);
    check(visibility);
}

TEST_CASE("README, temporal", "[examples]")
{
    const auto projection = ao::make_projection({ -1.0, 1.0, -0.5625, 0.5625, 0.1, 100.0 });
    const input in(ao::depth_source::linear, ao::pixel_format::r32f, projection);
    const ao::picture motion(ao::pixel_format::rg32f, width, height);
    const auto run = [&](int frames) {
        ao::picture visibility(ao::pixel_format::r32f, width, height);
        const auto wrong = run_temporal(in.depth, in.normals, motion, visibility, [&](ao::temporal_camera& view, bool&) {
            view.projection = projection;
            view.world_to_view[0][0] = view.world_to_view[1][1] = view.world_to_view[2][2] = 1;
            return frames-- > 0;
        });
        REQUIRE_FALSE(wrong);
        return visibility;
    };
    const ao::picture late = run(20);
    check(late);
    CHECK(late.bytes != run(1).bytes);
}

TEST_CASE("README, gl", "[examples]")
{
    auto context = ao::host::gl_context::create();
    REQUIRE(context);
    const input in(ao::depth_source::hardware, ao::pixel_format::d32f,
                   ao::make_projection({}, { .range = ao::depth_range::minus_one_to_one }));
    const auto made = [&](ao::pixel_format format) { return ao::host::gl_texture::create(**context, format, { width, height }); };
    auto depth = made(ao::pixel_format::d32f);
    auto normals = made(ao::pixel_format::rgba16f);
    auto visible = made(ao::pixel_format::r32f);
    REQUIRE((depth && normals && visible));
    REQUIRE((depth->upload(in.depth.bytes) && normals->upload(in.normals.bytes)));
    const auto wrong = run_gl((*context)->loader(), { depth->name, normals->name, visible->name }, width, height, two_frames());
    REQUIRE_FALSE(wrong);
    ao::picture visibility(ao::pixel_format::r32f, width, height);
    REQUIRE(visible->download(visibility.bytes));
    check(visibility);
}

TEST_CASE("README, vk", "[examples]")
{
    auto device = ao::host::vulkan_device::create();
    REQUIRE(device);
    ao::host::vulkan_device& gpu = **device;
    const input in(ao::depth_source::hardware, ao::pixel_format::d32f,
                   ao::make_projection({}, { .reversed = true, .y_down = true }));
    const auto made = [&](ao::pixel_format format) { return ao::host::vulkan_image::create(gpu, format, { width, height }); };
    auto depth = made(ao::pixel_format::d32f);
    auto normals = made(ao::pixel_format::rgba16f);
    auto visible = made(ao::pixel_format::r32f);
    REQUIRE((depth && normals && visible));
    REQUIRE(
        (depth->upload(in.depth.bytes, VK_IMAGE_LAYOUT_GENERAL) && normals->upload(in.normals.bytes, VK_IMAGE_LAYOUT_GENERAL)));
    REQUIRE(visible->transition(VK_IMAGE_LAYOUT_GENERAL));

    VkCommandPool pool = VK_NULL_HANDLE;
    const VkCommandPoolCreateInfo pool_info{ VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                             VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT, gpu.queue_family };
    REQUIRE(vkCreateCommandPool(gpu.device, &pool_info, nullptr, &pool) == VK_SUCCESS);
    VkCommandBuffer commands = VK_NULL_HANDLE;
    const VkCommandBufferAllocateInfo info{ VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                            VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1 };
    REQUIRE(vkAllocateCommandBuffers(gpu.device, &info, &commands) == VK_SUCCESS);
    int frame = 0;
    const auto next_frame = [&](ao::camera&) -> VkCommandBuffer {
        if (frame > 0) {
            REQUIRE(vkEndCommandBuffer(commands) == VK_SUCCESS);
            VkSubmitInfo submit{};
            submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
            submit.commandBufferCount = 1;
            submit.pCommandBuffers = &commands;
            REQUIRE(vkQueueSubmit(gpu.queue, 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS);
            REQUIRE(vkQueueWaitIdle(gpu.queue) == VK_SUCCESS);
        }
        if (frame++ == 2) {
            return VK_NULL_HANDLE;
        }
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        REQUIRE(vkBeginCommandBuffer(commands, &begin) == VK_SUCCESS);
        return commands;
    };
    ao::vk::context host;
    host.instance = gpu.instance;
    host.physical_device = gpu.physical;
    host.device = gpu.device;
    host.get_instance_proc_addr = vkGetInstanceProcAddr;
    const ao::host_images<ao::vk::image> views{ { depth->view }, { normals->view }, { visible->view } };
    const auto wrong = run_vk(host, views, width, height, next_frame);
    REQUIRE_FALSE(wrong);
    vkDestroyCommandPool(gpu.device, pool, nullptr);
    ao::picture visibility(ao::pixel_format::r32f, width, height);
    REQUIRE(visible->download(visibility.bytes));
    check(visibility);
}

TEST_CASE("README, scene", "[examples]")
{
    // A floor at y = -1 and a wall at z = -4 up to y = 0.
    const std::array<glm::vec3, 8> corners{ glm::vec3(-9, -1, 2), { 9, -1, 2 },  { 9, -1, -4 }, { -9, -1, -4 },
                                            { -9, -1, -4 },       { 9, -1, -4 }, { 9, 0, -4 },  { -9, 0, -4 } };
    const std::array<std::uint32_t, 12> indices{ 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };
    const ao::mesh mesh{ corners, {}, {}, {}, {}, indices };
    const ao::standard_material material;
    ao::object object;
    ao::scene scene;
    scene.meshes = { &mesh, 1 };
    scene.materials = { &material, 1 };
    scene.objects = { &object, 1 };
    scene.ambient = ao::ambient_light(glm::vec3(0.5F));
    ao::gbuffer_camera camera;
    camera.projection =
        ao::make_projection({ -1.0, 1.0, -0.5625, 0.5625, 0.1, 100.0 }, { .rows = ao::first_row::at_ndc_plus_one });
    ao::picture color(ao::pixel_format::rgba32f, width, height);
    REQUIRE_FALSE(draw_scene(scene, camera, color));
    const auto at = [&](int x, int y) { return color.texel<glm::vec4>(static_cast<std::size_t>(y * width + x)); };
    CHECK(at(32, 2) == glm::vec4(0.0F)); // nothing above the wall
    CHECK(at(32, 35).x > 0.48F);         // open floor: ambient light times the material's color
    CHECK(at(32, 35).x <= 0.5F);
    CHECK(at(32, 24).x < 0.35F); // near the crease
    CHECK(at(32, 24).x > 0.1F);

    object.mesh = 3;
    CHECK(draw_scene(scene, camera, color)->code() == ao::errc::invalid_scene);
}
