// The OpenGL backend inside a hostile host: state put back, pictures right whatever the state was, errors that say what is wrong.
#include "ao/backend.hpp"
#include "ao/conformance/reference.hpp"
#include "ao/conformance/shade_reference.hpp"
#include "ao/gl/backend.hpp"
#include "ao/gl/rasterizer.hpp"
#include "ao/gl/shading.hpp"
#include "unit/gl_hostile.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

using namespace gl_test;
using ao::pixel_format;
using Catch::Matchers::Contains;

namespace {

constexpr int width = 33;
constexpr int height = 17;

// Waves of hardware depth with one normal.
struct waves {
    ao::facts facts;
    ao::camera camera;
    ao::picture depth;
    ao::picture normal;

    waves()
    {
        facts.width = width;
        facts.height = height;
        facts.depth = ao::depth_source::hardware;
        facts.depth_format = pixel_format::d24;
        ao::projection_options o;
        o.range = ao::depth_range::minus_one_to_one;
        camera.projection = ao::make_projection({}, o);
        std::vector<float> d;
        for (int i = 0; i < width * height; ++i) {
            d.push_back(3 + std::sin(static_cast<float>(i) * 0.37F));
        }
        const std::vector<glm::vec3> n(d.size(), glm::vec3(0.6F, 0, 0.8F));
        depth = ao::pack_depth(d, width, height, facts.depth, facts.depth_format, camera.projection);
        normal = ao::pack_normals(n, width, height, ao::normal_source::vector, pixel_format::rgba16f);
    }
};

// Loaders that lack something.
const char* hidden = "";
void (*partial_loader(const char* name))()
{
    return std::strcmp(name, hidden) == 0 ? nullptr : context().loader()(name);
}
void* empty_loader(const char*)
{
    return nullptr;
}

} // namespace

TEST_CASE("creation names what is missing")
{
    context();
    const auto reason = [](const auto& made) {
        REQUIRE_FALSE(made);
        return std::string(made.error().reason());
    };
    CHECK_THAT(reason(ao::gl::backend::create(static_cast<ao::gl::backend::get_proc_address>(nullptr))), Contains("no loader"));
    CHECK_THAT(reason(ao::gl::backend::create(empty_loader)), Contains("no OpenGL entry points"));
    CHECK_THAT(reason(ao::gl::rasterizer::create(empty_loader)), Contains("no OpenGL entry points"));
    CHECK_THAT(reason(ao::gl::shading::create(empty_loader)), Contains("no OpenGL entry points"));
    hidden = "glTextureView";
    CHECK_THAT(reason(ao::gl::backend::create(partial_loader)), Contains("glTextureView is missing"));
    hidden = "glMultiDrawElementsIndirect";
    CHECK_THAT(reason(ao::gl::rasterizer::create(partial_loader)), Contains("glMultiDrawElementsIndirect is missing"));
    hidden = "";
    ao::gl::options large;
    large.group_width = large.group_height = 64;
    CHECK(ao::gl::backend::create(context().loader(), large).error().code() == ao::errc::invalid_settings);
    CHECK(ao::gl::shading::create(context().loader(), large).error().code() == ao::errc::invalid_settings);
    large.group_width = 0;
    CHECK(ao::gl::backend::create(context().loader(), large).error().code() == ao::errc::invalid_settings);
}

TEST_CASE("binding names the texture that does not fit")
{
    const waves w;
    auto gl = ao::gl::backend::create(context().loader());
    REQUIRE(gl);
    ao::facts wide = w.facts;
    wide.width = 60000;
    CHECK(ao::effect<ao::gl::backend>::create(*gl, {}, wide, w.camera).error().code() == ao::errc::invalid_size);
    auto effect = ao::effect<ao::gl::backend>::create(*gl, {}, w.facts, w.camera);
    REQUIRE(effect);
    const auto depth = upload(w.depth);
    const auto normal = upload(w.normal);
    const auto visibility = make_texture(pixel_format::r32f, width, height);
    const auto small = make_texture(pixel_format::r32f, 8, 8);
    const auto reason = [&](unsigned d, unsigned n, unsigned v) {
        const auto bound = effect->bind({ d, n, v });
        REQUIRE_FALSE(bound);
        return std::string(bound.error().reason());
    };
    CHECK_THAT(reason(0, normal.name, visibility.name), Contains("depth texture 0"));
    CHECK_THAT(reason(depth.name, 4711, visibility.name), Contains("normal texture 4711"));
    CHECK_THAT(reason(normal.name, normal.name, visibility.name), Contains("depth texture") && Contains("format"));
    CHECK_THAT(reason(depth.name, normal.name, normal.name), Contains("visibility texture") && Contains("format"));
    CHECK_THAT(reason(depth.name, normal.name, small.name), Contains("8x8"));
    GLuint cube = 0;
    entry<decltype(glCreateTextures)>("glCreateTextures")(GL_TEXTURE_CUBE_MAP, 1, &cube);
    entry<decltype(glTextureStorage2D)>("glTextureStorage2D")(cube, 1, GL_R32F, 8, 8);
    CHECK_THAT(reason(depth.name, normal.name, cube), Contains("not GL_TEXTURE_2D"));
    entry<decltype(glDeleteTextures)>("glDeleteTextures")(1, &cube);

    GLuint mutable_depth = 0;
    AO_ENTRY(BindTexture);
    entry<decltype(glGenTextures)>("glGenTextures")(1, &mutable_depth);
    BindTexture(GL_TEXTURE_2D, mutable_depth);
    entry<decltype(glTexImage2D)>("glTexImage2D")(GL_TEXTURE_2D, 0, GL_DEPTH24_STENCIL8, width, height, 0, GL_DEPTH_STENCIL,
                                                  GL_UNSIGNED_INT_24_8, nullptr);
    BindTexture(GL_TEXTURE_2D, 0);
    entry<decltype(glTextureParameteri)>("glTextureParameteri")(mutable_depth, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    CHECK_THAT(reason(mutable_depth, normal.name, visibility.name), Contains("stencil mode"));
    entry<decltype(glDeleteTextures)>("glDeleteTextures")(1, &mutable_depth);

    ao::settings unfiltered;
    unfiltered.filter = 1;
    const auto other = ao::make_plan(unfiltered, w.facts, w.camera);
    auto program = gl->prepare(*other);
    REQUIRE(program);
    const auto bound = gl->bind(*program, effect->current_plan(), { depth.name, normal.name, visibility.name });
    CHECK(bound.error().code() == ao::errc::plan_mismatch);
}

TEST_CASE("hostile state changes no bit of the visibility, and is put back where that is asked for")
{
    const waves w;
    auto depth = upload(w.depth);
    auto normal = upload(w.normal);
    auto visibility = make_texture(pixel_format::r32f, width, height);
    const hostile_state host;
    AO_ENTRY(TextureParameteri);
    TextureParameteri(depth.name, GL_TEXTURE_SWIZZLE_R, GL_ONE);
    TextureParameteri(depth.name, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    TextureParameteri(depth.name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    TextureParameteri(normal.name, GL_TEXTURE_SWIZZLE_G, GL_RED);
    TextureParameteri(normal.name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    TextureParameteri(visibility.name, GL_TEXTURE_SWIZZLE_R, GL_ZERO);
    // The fragment route without restoring comes last: it leaves the state changed.
    for (const auto& [by, restore] :
         { std::pair{ ao::gl::route::compute, true }, std::pair{ ao::gl::route::fragment, true },
           std::pair{ ao::gl::route::compute, false }, std::pair{ ao::gl::route::fragment, false } }) {
        INFO("route " << static_cast<int>(by) << ", restore " << restore);
        ao::gl::options o;
        o.route = by;
        o.restore_state = restore;
        auto gl = ao::gl::backend::create(context().loader(), o);
        REQUIRE(gl);
        host.set_unpack();
        const std::string before = snapshot();
        auto effect = ao::effect<ao::gl::backend>::create(*gl, {}, w.facts, w.camera);
        REQUIRE(effect);
        auto bound = effect->bind({ depth.name, normal.name, visibility.name });
        REQUIRE(bound);
        CHECK(snapshot() == before);
        // Twice, with other constants, so that the second pass sees what the first left.
        for (const float background : { 3.5F, std::numeric_limits<float>::max() }) {
            ao::camera c = w.camera;
            c.background = background;
            REQUIRE_FALSE(effect->set_camera(c));
            effect->record({}, *bound);
        }
        CHECK(take_error() == GL_NO_ERROR);
        CHECK((snapshot() == before) == restore);
        TextureParameteri(visibility.name, GL_TEXTURE_SWIZZLE_R, GL_RED);
        const ao::picture got = download(visibility);
        TextureParameteri(visibility.name, GL_TEXTURE_SWIZZLE_R, GL_ZERO);
        CHECK(differing(got, ao::conformance::reference_visibility(effect->current_plan(), w.depth, w.normal)) == 0);
    }
}

TEST_CASE("hostile state changes no bit of a geometry pass or its shading, and is put back where that is asked for")
{
    context();
    const std::vector<glm::vec3> positions{ { -1, -1, -3 }, { 1, -1, -3 }, { 0.3F, 1, -2 } };
    const std::vector<glm::vec3> normals(3, glm::vec3(0, 0, 1));
    const std::vector<glm::vec4> tangents(3, glm::vec4(1, 0, 0, 1));
    const std::vector<glm::vec2> uvs{ { 0, 0 }, { 1, 0 }, { 0, 1 } };
    const std::vector<std::uint32_t> indices{ 0, 1, 2 };
    const std::vector<std::uint8_t> texels{ 100, 140, 250, 255, 150, 120, 240, 200 };
    ao::mesh mesh;
    mesh.positions = positions;
    mesh.normals = normals;
    mesh.tangents = tangents;
    mesh.uvs = uvs;
    mesh.indices = indices;
    ao::texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.texels = texels;
    ao::standard_material material;
    material.two_sided = false;
    material.diffuse_map = material.normal_map = material.alpha_map = 0;
    const ao::object object;
    const ao::light light;
    ao::scene s;
    s.meshes = { &mesh, 1 };
    s.textures = { &texture, 1 };
    s.materials = { &material, 1 };
    s.objects = { &object, 1 };
    s.lights = { &light, 1 };
    s.ambient = ao::ambient_light(glm::vec3(0.3F));
    ao::gbuffer_facts f;
    f.width = width;
    f.height = height;
    f.depth_format = pixel_format::d24;
    f.ids = f.surface = true;
    ao::gbuffer_camera camera;
    ao::projection_options o;
    o.range = ao::depth_range::minus_one_to_one;
    o.reversed = true;
    camera.projection = ao::make_projection({}, o);
    ao::shade_facts shade;
    shade.width = width;
    shade.height = height;
    shade.depth_format = pixel_format::d24;
    shade.visibility = false;
    const auto plan = ao::plan_drawing(s, f);
    const auto shade_plan = ao::make_shade_plan(s, shade, { camera.projection, camera.view });
    const auto heap = ao::make_texel_heap(s.textures);
    REQUIRE(plan);
    REQUIRE(shade_plan);
    const auto depth = make_texture(pixel_format::d24, width, height);
    const auto normal = make_texture(pixel_format::rgba16f, width, height);
    const auto ids = make_texture(pixel_format::rg32ui, width, height);
    const auto surface = make_texture(pixel_format::rgba32f, width, height);
    const auto color = make_texture(pixel_format::rgba32f, width, height);

    const auto run = [&](ao::gl::sampling sampling, bool restore, const hostile_state* host) {
        auto raster = ao::gl::rasterizer::create(context().loader(), { ao::gl::shader_source::automatic, sampling, restore });
        ao::gl::options options;
        options.restore_state = restore;
        auto shading = ao::gl::shading::create(context().loader(), options);
        REQUIRE(raster);
        REQUIRE(shading);
        if (host != nullptr) {
            host->set_unpack();
        }
        const std::string before = snapshot();
        auto model = raster->load(s, *plan);
        REQUIRE(model);
        auto targets = raster->bind(*model, { depth.name, 0, normal.name, 0, ids.name, surface.name, 0 });
        REQUIRE(targets);
        auto program = shading->prepare_shading(*shade_plan, *heap);
        REQUIRE(program);
        auto bound = shading->bind_shading(*program, *shade_plan,
                                           { depth.name, 0, normal.name, ids.name, surface.name, 0, 0, color.name });
        REQUIRE(bound);
        CHECK(snapshot() == before);
        raster->record({}, *model, *targets, camera);
        CHECK((snapshot() == before) == restore);
        shading->record_shading({}, *program, *bound, *shade_plan, 0);
        CHECK((snapshot() == before) == restore);
        CHECK(take_error() == GL_NO_ERROR);
        return std::array<ao::picture, 5>{ download(depth), download(normal), download(ids), download(surface), download(color) };
    };
    for (const auto sampling : { ao::gl::sampling::shared, ao::gl::sampling::hardware }) {
        const auto quiet = run(sampling, true, nullptr);
        std::size_t covered = 0;
        for (std::size_t i = 0; i < quiet[2].pixels(); ++i) {
            covered += quiet[2].texel<glm::uvec2>(i).x;
        }
        CHECK(covered > 20);
        ao::conformance::shade_inputs in;
        in.geometry = quiet[0];
        in.normal = quiet[1];
        in.ids = quiet[2];
        in.surface = quiet[3];
        CHECK(differing(quiet[4], ao::conformance::reference_color(*shade_plan, *heap, in)) == 0);
        for (const bool restore : { true, false }) {
            const hostile_state host;
            const auto hostile = run(sampling, restore, &host);
            for (std::size_t i = 0; i < quiet.size(); ++i) {
                INFO("picture " << i << ", restore " << restore << ", sampling " << static_cast<int>(sampling));
                CHECK(differing(quiet[i], hostile[i]) == 0);
            }
        }
    }
}

TEST_CASE("odd sizes, mutable textures, every group size and both sources give the same visibility")
{
    const waves w;
    for (const auto& [wide, high] : { std::pair{ 1, 1 }, std::pair{ 1, 77 }, std::pair{ 77, 1 }, std::pair{ 15, 17 } }) {
        ao::facts f;
        f.width = wide;
        f.height = high;
        f.normals = ao::normal_source::from_depth;
        std::vector<float> d;
        for (int i = 0; i < wide * high; ++i) {
            d.push_back(3 + std::sin(static_cast<float>(i) * 0.37F));
        }
        const auto depth = ao::pack_depth(d, wide, high, ao::depth_source::linear, pixel_format::r32f, w.camera.projection);
        GLuint texture = 0;
        AO_ENTRY(BindTexture);
        entry<decltype(glGenTextures)>("glGenTextures")(1, &texture);
        BindTexture(GL_TEXTURE_2D, texture);
        entry<decltype(glTexImage2D)>("glTexImage2D")(GL_TEXTURE_2D, 0, GL_R32F, wide, high, 0, GL_RED, GL_FLOAT,
                                                      depth.bytes.data());
        BindTexture(GL_TEXTURE_2D, 0);
        for (const auto source : { ao::gl::shader_source::spirv, ao::gl::shader_source::text }) {
            for (const auto& [across, down] : { std::pair{ 8U, 8U }, std::pair{ 64U, 1U }, std::pair{ 5U, 3U } }) {
                if (source == ao::gl::shader_source::text && across != 5) {
                    continue;
                }
                INFO(wide << "x" << high << " in groups of " << across << "x" << down);
                ao::gl::options o;
                o.source = source;
                o.group_width = across;
                o.group_height = down;
                auto gl = ao::gl::backend::create(context().loader(), o);
                REQUIRE(gl);
                auto effect = ao::effect<ao::gl::backend>::create(*gl, {}, f, w.camera);
                REQUIRE(effect);
                const auto visibility = make_texture(pixel_format::r32f, wide, high);
                auto bound = effect->bind({ texture, 0, visibility.name });
                REQUIRE(bound);
                effect->record({}, *bound);
                CHECK(differing(download(visibility), ao::conformance::reference_visibility(effect->current_plan(), depth, {})) ==
                      0);
            }
        }
        entry<decltype(glDeleteTextures)>("glDeleteTextures")(1, &texture);
    }
}
