#include "aero/page_parts.h"

#include <cstdio>
#include <cstdlib>

#include "aero/base64_text.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

constexpr const char* style =
    ":root{color-scheme:light}body{margin:0 auto;max-width:1100px;padding:20px;font:15px/1.5 "
    "system-ui,'DejaVu "
    "Sans',sans-serif;color:#1d2329;background:#fcfcfa}h1{font-size:26px}h2{font-size:19px;margin-top:36px;"
    "border-top:1px solid #d9dcdf;padding-top:12px}table{border-collapse:collapse;font-variant-numeric:"
    "tabular-nums}th,td{padding:3px 10px;border-bottom:1px solid #d9dcdf;text-align:right}th{text-align:left;"
    "font-weight:500;color:#4b545c}img{max-width:100%;display:block;margin:10px 0}.pair{display:grid;"
    "grid-template-columns:1fr 1fr;gap:10px}.outlines{width:100%}.outlines polygon{fill:none;stroke-width:3}"
    ".first{stroke:#1f5aa6;color:#1f5aa6}.last{stroke:#cc4026;color:#cc4026}.note{color:#667079}"
    "pre{overflow-x:auto;background:#f0f1f0;padding:10px;font-size:12px}@media(max-width:700px){.pair{"
    "grid-template-columns:1fr}}";

}  // namespace

std::string number(double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text)
    result += c == '<'    ? "&lt;"
              : c == '>'  ? "&gt;"
              : c == '&'  ? "&amp;"
              : c == '"'  ? "&quot;"
              : c == '\'' ? "&#39;"
                          : std::string(1, c);
  return result;
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th>" + name + "</th><td>" + value + "</td></tr>\n";
}

std::string cells(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) result += "<td>" + text + "</td>";
  return result;
}

std::string page_head(const std::string& title) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\"><title>" +
         escaped(title) + "</title><style>" + style + "</style></head><body>\n";
}

Scratch::Scratch() {
  std::string name = (fs::temp_directory_path() / "remodel-report-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw Error(ErrorCode::file, name, "cannot make a temporary directory");
  path_ = name;
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Scratch::picture(const char* extension, const std::function<void(const fs::path&)>& write) const {
  const fs::path file = path_ / (std::string("picture") + extension);
  write(file);
  const std::string kind = extension == std::string(".svg") ? "svg+xml" : "png";
  return "<img alt=\"\" src=\"data:image/" + kind + ";base64," + base64_text(read_text(file)) + "\">\n";
}

}  // namespace remodel
