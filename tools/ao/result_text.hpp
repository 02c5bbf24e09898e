#pragma once

#include "ao/gbuffer.hpp"
#include "ao/options.hpp"
#include "ao/temporal_settings.hpp"

#include <string>

namespace ao::tools {

// Words and numbers of the report and the JSON.
[[nodiscard]] std::string text(double value);
[[nodiscard]] std::string text(float value);
[[nodiscard]] std::string size_text(extent size);
[[nodiscard]] const char* method_text(method m);
[[nodiscard]] const char* pass_text(pass_type type);
[[nodiscard]] const char* depth_text(const facts& f);
[[nodiscard]] const char* normals_text(const facts& f);
[[nodiscard]] const char* contribution_text(contribution_type c);
[[nodiscard]] const char* density_text(sample_density d);
[[nodiscard]] const char* history_text(history_format f);
[[nodiscard]] const char* invalidation_text(invalidation_type i);
[[nodiscard]] std::string projection_text(const projection_choice& p);
// "alpha map, normal map, culled"; "plain" where there is nothing to do.
[[nodiscard]] std::string variant_text(const draw_variant& v);

} // namespace ao::tools
