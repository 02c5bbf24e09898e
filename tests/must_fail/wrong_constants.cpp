// Each pass takes its own struct of constants.
#include <ao/plan.hpp>

struct one_row {
    float visibility(glm::ivec2) const { return 1.0F; }
    glm::vec2 row_sum(glm::ivec2) const { return { 1.0F, 1.0F }; }
};
using pass = ao::filter_pass<float, one_row>;

float run(pass& body, const ao::occlusion_constants& others, const pass::ao_filter_constants& own)
{
#ifdef AO_MISUSE
    static_cast<void>(own);
    return body.ao_filter_columns_pass(others, { 0, 0 });
#else
    static_cast<void>(others);
    return body.ao_filter_columns_pass(own, { 0, 0 });
#endif
}
