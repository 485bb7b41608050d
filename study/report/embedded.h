#pragma once

// Files embedded into the program: the paper's tables and the parts of the page.

#include <string_view>

namespace remodel::report {

std::string_view embedded_paper_tables();  // study/data/paper_tables.csv
std::string_view embedded_page();          // study/page/page.html
std::string_view embedded_style();         // study/page/page.css
std::string_view embedded_script();        // study/page/page.js
// Vega, Vega-Lite and Vega-Embed, concatenated; empty if the program was built without them.
std::string_view embedded_vega();
std::string_view embedded_vega_lite();
std::string_view embedded_vega_embed();
std::string_view embedded_vega_licence();
std::string_view embedded_vega_lite_licence();
std::string_view embedded_vega_embed_licence();

}  // namespace remodel::report
