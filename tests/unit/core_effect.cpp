// ao::effect over a backend that writes down what it is asked to do.
#include "ao/backend.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace {

struct log_book {
    using image = int;
    using commands = std::vector<ao::pass_type>*;
    struct program {
        std::size_t passes;
    };
    struct binding {
        int visibility;
    };
    bool refuse = false;
    float last_radius = 0;

    ao::result<program> prepare(const ao::plan& p)
    {
        if (refuse) {
            return ao::error(ao::errc::device, "no", 7);
        }
        return program{ p.passes.size() };
    }
    ao::result<binding> bind(program&, const ao::plan&, const ao::host_images<int>& images)
    {
        return binding{ images.visibility };
    }
    void record_pass(commands out, program&, binding&, const ao::plan& p, std::size_t index)
    {
        out->push_back(p.passes[index].type);
        if (p.passes[index].type == ao::pass_type::occlusion) {
            last_radius = ao::constants_of<ao::occlusion_constants>(p.passes[index]).radius;
        }
    }
};
static_assert(ao::backend<log_book>);

ao::facts scene()
{
    ao::facts f;
    f.width = 16;
    f.height = 8;
    return f;
}
ao::camera view(bool parallel = false)
{
    ao::projection_options options;
    options.parallel = parallel;
    ao::camera c;
    c.projection = ao::make_projection({}, options);
    return c;
}

} // namespace

TEST_CASE("An effect records the plan's passes in order", "[core][effect]")
{
    log_book backend;
    auto effect = ao::effect<log_book>::create(backend, {}, scene(), view());
    REQUIRE(effect);
    auto bound = effect->bind({ 1, 2, 3 });
    REQUIRE(bound);
    CHECK(bound->visibility == 3);
    std::vector<ao::pass_type> recorded;
    effect->record(&recorded, *bound);
    CHECK(recorded == std::vector{ ao::pass_type::occlusion, ao::pass_type::filter_rows, ao::pass_type::filter_columns });
    recorded.clear();
    effect->record_pass(&recorded, *bound, 1);
    CHECK(recorded == std::vector{ ao::pass_type::filter_rows });
}

TEST_CASE("Creating an effect reports what is wrong", "[core][effect]")
{
    log_book backend;
    ao::settings wrong;
    wrong.taps = 0;
    CHECK(ao::effect<log_book>::create(backend, wrong, scene(), view()).error().code() == ao::errc::invalid_settings);
    CHECK(ao::effect<log_book>::create(backend, {}, {}, view()).error().code() == ao::errc::invalid_size);
    CHECK(ao::effect<log_book>::create(backend, {}, scene(), view(true)).error().code() == ao::errc::invalid_projection);
    backend.refuse = true;
    const auto refused = ao::effect<log_book>::create(backend, {}, scene(), view());
    REQUIRE_FALSE(refused);
    CHECK(refused.error().native() == 7);
    CHECK(refused.error().reason() == "no");
}

TEST_CASE("New settings apply where the structure stays, and are refused where it does not", "[core][effect]")
{
    log_book backend;
    auto effect = ao::effect<log_book>::create(backend, {}, scene(), view());
    REQUIRE(effect);
    auto bound = effect->bind({ 1, 2, 3 });
    std::vector<ao::pass_type> recorded;

    ao::settings s;
    s.radius = 3;
    CHECK_FALSE(effect->set_settings(s, view()));
    effect->record(&recorded, *bound);
    CHECK(backend.last_radius == 3.0F);

    s.taps = 16;
    s.radius = 4;
    const auto mismatch = effect->set_settings(s, view());
    REQUIRE(mismatch);
    CHECK(mismatch->code() == ao::errc::plan_mismatch);
    s.radius = -1;
    CHECK(effect->set_settings(s, view())->code() == ao::errc::invalid_settings);
    effect->record(&recorded, *bound);
    CHECK(backend.last_radius == 3.0F);
    CHECK(effect->current_plan().settings.taps == 32);
}

TEST_CASE("A camera that fails leaves the last one in place", "[core][effect]")
{
    log_book backend;
    auto effect = ao::effect<log_book>::create(backend, {}, scene(), view());
    REQUIRE(effect);
    const auto before = effect->current_plan().passes[0].constants;
    CHECK(effect->set_camera(view(true))->code() == ao::errc::invalid_projection);
    ao::camera broken = view();
    broken.projection.matrix[0][0] = 0;
    CHECK(effect->set_camera(broken)->code() == ao::errc::invalid_projection);
    CHECK(effect->current_plan().passes[0].constants == before);
    ao::camera moved = view();
    moved.projection = ao::make_projection({ -2, 2, -1, 1, 0.1, 50 });
    CHECK_FALSE(effect->set_camera(moved));
    CHECK(effect->current_plan().passes[0].constants != before);
}
