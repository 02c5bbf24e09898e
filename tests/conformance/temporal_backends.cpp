// 200 frames of every motion on every backend: the reference's bits, history included, from the same pictures.
#include "host/temporal_runner.hpp"
#include "unit/temporal_measures.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <string_view>

using namespace temporal_test;

namespace {

std::size_t differing_bytes(const ao::picture& a, const picture& b)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < b.texels.size(); ++i) {
        count += std::memcmp(a.bytes.data() + 4 * i, &b.texels[i].x, 4) == 0 ? 0 : 1;
    }
    return count;
}

std::size_t differing_words(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b)
{
    REQUIRE(a.size() == b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        count += a[i] == b[i] ? 0 : 1;
    }
    return count;
}

// Objects that move need a motion picture; without them a plan may stop where the camera does.
bool moves_objects(const path& p)
{
    const stage first = p.at(0);
    return first.ball != p.at(1).ball;
}

} // namespace

TEST_CASE("after 200 frames of every motion no bit differs between the backends")
{
    auto runners = ao::host::make_temporal_runners("all");
    REQUIRE(runners);
    REQUIRE(runners->size() >= 1);
    for (const path& p : paths) {
        for (const auto format : { ao::history_format::precise, ao::history_format::packed }) {
            ao::temporal_settings s;
            s.format = format;
            const ao::temporal_facts f = facts_of(p.at(0), moves_objects(p));
            executor reference = make_executor(s, f);
            for (auto& runner : *runners) {
                REQUIRE(runner->prepare(s, f));
            }
            stage before = p.at(0);
            for (int i = 0; i < 200; ++i) {
                const stage now = p.at(i);
                const bool anew = i == 0 || (p.name == std::string_view("cut") && i == 16);
                const scene_frame frame = make_frame(now, anew ? now : before);
                const picture& expected = reference.run(frame.inputs, frame.camera, anew);
                before = now;
                for (auto& runner : *runners) {
                    REQUIRE(runner->upload(frame.inputs.depth, frame.inputs.normal, frame.inputs.motion));
                    const auto passes = runner->frame(frame.camera, anew);
                    REQUIRE(passes);
                    REQUIRE(passes->size() == reference.steps());
                    if (i % 25 != 24 || !runner->exact()) {
                        continue;
                    }
                    INFO(p.name << ", " << runner->name() << ", frame " << i);
                    const auto seen = runner->download();
                    const auto history = runner->history();
                    REQUIRE(seen);
                    REQUIRE(history);
                    REQUIRE(differing_bytes(*seen, expected) == 0);
                    REQUIRE(differing_words(*history, reference.history()) == 0);
                }
            }
            for (auto& runner : *runners) {
                CHECK(runner->messages().empty());
            }
        }
    }
}

TEST_CASE("a size that changes with every frame begins anew each time, on every backend")
{
    auto runners = ao::host::make_temporal_runners("all");
    REQUIRE(runners);
    const ao::temporal_settings s;
    for (int i = 0; i < 12; ++i) {
        stage now = small_stage();
        now.width = 3 + 7 * i;
        now.height = 1 + 40 / (i + 1);
        const scene_frame frame = make_frame(now, now);
        const ao::temporal_facts f = facts_of(now, true);
        executor reference = make_executor(s, f);
        const picture& expected = reference.run(frame.inputs, frame.camera);
        for (auto& runner : *runners) {
            INFO(runner->name() << ", " << now.width << " x " << now.height);
            REQUIRE(runner->prepare(s, f));
            REQUIRE(runner->upload(frame.inputs.depth, frame.inputs.normal, frame.inputs.motion));
            REQUIRE(runner->frame(frame.camera));
            const auto seen = runner->download();
            REQUIRE(seen);
            if (runner->exact()) {
                CHECK(differing_bytes(*seen, expected) == 0);
            }
        }
    }
}
