// Projection and reconstruction at run time: round trips in every convention, and what storing a depth costs.
#include "unit/core_pictures.hpp"

#include "ao/picture.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace core_test;

namespace {

struct convention {
    ao::camera_projection camera;
    bool parallel;
    bool reversed;
};

// 64: range, first row, reversed, Y, off-centre, {finite, infinite | parallel}.
convention convention_of(int bits, double near, double far)
{
    ao::projection_options options;
    options.range = (bits & 1) != 0 ? ao::depth_range::minus_one_to_one : ao::depth_range::zero_to_one;
    options.rows = (bits & 2) != 0 ? ao::first_row::at_ndc_plus_one : ao::first_row::at_ndc_minus_one;
    options.reversed = (bits & 4) != 0;
    options.y_down = (bits & 8) != 0;
    ao::frustum f{ -1, 1, -0.6, 0.6, near, far };
    if ((bits & 16) != 0) {
        f = { -0.5, 1.75, -0.9, 0.2, near, far };
    }
    if (bits >= 64) {
        options.parallel = true;
        f.left *= 20;
        f.right *= 20;
        f.bottom *= 20;
        f.top *= 20;
    }
    else if ((bits & 32) != 0) {
        f.far = std::numeric_limits<double>::infinity();
    }
    return { ao::make_projection(f, options), options.parallel, options.reversed };
}
constexpr int conventions = 96;

} // namespace

TEMPLATE_TEST_CASE("Reconstructing and projecting comes back to the pixel within .01", "[core][projection]", float, double,
                   lanes8)
{
    using m = ao::math<TestType>;
    const int width = 1920;
    const int height = 1080;
    std::vector<std::array<float, 3>> inputs;
    std::mt19937 engine(4);
    for (int i = 0; i < 2000; ++i) {
        std::uniform_real_distribution<float> column(0, static_cast<float>(width));
        std::uniform_real_distribution<float> row(0, static_cast<float>(height));
        std::uniform_real_distribution<float> scale(-1, 3);
        inputs.push_back({ column(engine), row(engine), std::pow(10.0F, scale(engine)) });
    }
    for (int bits = 0; bits < conventions; ++bits) {
        const convention c = convention_of(bits, 0.1, 1000);
        const auto folded = ao::fold_projection(c.camera, width, height);
        REQUIRE(folded);
        const auto p =
            ao::convert_constants<typename m::ao_projection, TestType, ao::math<float>::ao_projection, float>(folded->projection);
        const auto outputs = evaluate<TestType>(inputs, [&](const std::array<TestType, 3>& in) {
            const auto point = m::ao_view_point(p, typename m::vec2(in[0], in[1]), in[2], c.parallel);
            const auto pixel = m::ao_to_pixel(p, point, c.parallel);
            return std::array{ pixel.x, pixel.y };
        });
        double worst = 0;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            worst = std::max({ worst, std::abs(outputs[i][0] - static_cast<double>(inputs[i][0])),
                               std::abs(outputs[i][1] - static_cast<double>(inputs[i][1])) });
        }
        CAPTURE(bits);
        CHECK(worst < 0.01);
    }
}

TEST_CASE("Two ways of saying which way up a picture is stored are one", "[core][projection]")
{
    for (const bool parallel : { false, true }) {
        ao::projection_options a;
        a.parallel = parallel;
        ao::projection_options b = a;
        b.rows = ao::first_row::at_ndc_plus_one;
        b.y_down = true;
        const ao::frustum f{ -1, 2, -0.5, 0.25, 0.1, 100 };
        const auto x = ao::fold_projection(ao::make_projection(f, a), 640, 360)->projection;
        const auto y = ao::fold_projection(ao::make_projection(f, b), 640, 360)->projection;
        using reals = std::array<std::uint32_t, 8>;
        CHECK(std::bit_cast<reals>(x) == std::bit_cast<reals>(y));
    }
}

TEST_CASE("A stored depth comes back within what the plan adds to the bias", "[core][projection]")
{
    struct storage {
        ao::depth_source source;
        ao::pixel_format format;
    };
    const storage kind = GENERATE(storage{ ao::depth_source::hardware, ao::pixel_format::d32f },
                                  storage{ ao::depth_source::hardware, ao::pixel_format::d24 },
                                  storage{ ao::depth_source::position, ao::pixel_format::rgba32f },
                                  storage{ ao::depth_source::position, ao::pixel_format::rgba16f });
    const int width = 64;
    const int height = 32;
    for (int bits = 0; bits < conventions; ++bits) {
        const convention c = convention_of(bits, 0.1, 1000);
        ao::facts f;
        f.width = width;
        f.height = height;
        f.depth = kind.source;
        f.depth_format = kind.format;
        f.parallel = c.parallel;
        ao::camera view;
        view.projection = c.camera;
        const auto plan = ao::make_plan({}, f, view);
        REQUIRE(plan);
        const auto bias = ao::constants_of<ao::occlusion_constants>(pass_of(*plan, ao::pass_type::occlusion));
        const ao::pass& linearize = pass_of(*plan, ao::pass_type::linearize);

        std::vector<float> depth(static_cast<std::size_t>(width * height));
        std::mt19937 engine(6);
        std::uniform_real_distribution<float> exponent(-0.8F, 2.9F);
        for (float& d : depth) {
            d = std::pow(10.0F, exponent(engine));
        }
        depth[5] = 0;
        const ao::picture packed = ao::pack_depth(depth, width, height, kind.source, kind.format, c.camera);
        struct resource {
            const ao::picture* picture;
            float stored_depth(glm::ivec2 p) const
            {
                const auto i = static_cast<std::size_t>(p.y * picture->width + p.x);
                switch (picture->format) {
                case ao::pixel_format::rgba32f:
                    return picture->texel<glm::vec4>(i).z;
                case ao::pixel_format::rgba16f:
                    return ao::half_to_float(picture->texel<std::array<std::uint16_t, 4>>(i)[2]);
                case ao::pixel_format::d24:
                    return static_cast<float>(picture->texel<std::uint32_t>(i)) / 16777215.0F;
                default:
                    return picture->texel<float>(i);
                }
            }
        };
        using body = ao::linearize_pass<float, resource>;
        body pass{ { &packed } };
        pass.ao_affine = linearize.options.affine;
        const auto constants = ao::convert_constants<body::ao_depth_decode, float, ao::linearize_constants, float>(
            ao::constants_of<ao::linearize_constants>(linearize));
        double worst = 0;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto truth = static_cast<double>(depth[static_cast<std::size_t>(y * width + x)]);
                const auto d = static_cast<double>(pass.ao_linearize_pass(constants, { x, y }));
                if (truth == 0) {
                    CHECK(d == 0);
                    continue;
                }
                const double allowed =
                    static_cast<double>(bias.bias) - static_cast<double>(ao::settings().bias) +
                    truth * (static_cast<double>(bias.bias_linear) + truth * static_cast<double>(bias.bias_quadratic));
                // The bias covers the pixel's error and the tap's.
                worst = std::max(worst, std::abs(d - truth) / (allowed / 2));
            }
        }
        CAPTURE(bits, static_cast<int>(kind.format), worst);
        CHECK(worst <= 1);
    }
}
