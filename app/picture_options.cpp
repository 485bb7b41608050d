#include "picture_options.h"

#include "arguments.h"
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

}  // namespace remodel::app
