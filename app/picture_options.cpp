#include "picture_options.h"

#include <algorithm>
#include <filesystem>

#include "arguments.h"
#include "outputs.h"
#include "remodel/error.h"

namespace remodel::app {

void add_window(CLI::App& app, const std::string& default_text, DrawOptions& options) {
  add_text(app, {"--window", "X0,Y0,X1,Y1", default_text, "Part of the plane to draw: corners in chords"},
           Presence::optional, [&options](const std::string& text) {
             const std::vector<double> corners = parse_reals("--window", text, 4);
             if (!(corners[0] < corners[2] && corners[1] < corners[3])) {
               throw Error(ErrorCode::argument, "--window",
                           "found '" + text + "', expected x0 < x1 and y0 < y1");
             }
             options.window = {{corners[0], corners[1], corners[2], corners[3]}};
           });
}

void require_picture(const std::string& file, std::initializer_list<const char*> extensions) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    std::string expected;
    for (const char* one : extensions) expected += (expected.empty() ? "" : " or ") + std::string(one);
    throw Error(ErrorCode::argument, file, "found extension '" + extension + "', expected " + expected);
  }
  require_writable(file);
}

}  // namespace remodel::app
