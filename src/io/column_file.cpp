#include "io/column_file.h"

#include <set>

#include "io/hdf5_file.h"
#include "remodel/io.h"

namespace remodel::io {

void write_columns(const std::filesystem::path& file, const std::vector<FileColumn>& columns,
                   const std::vector<FileAttribute>& attributes) {
  Hdf5Writer out(file.string());
  std::set<std::string> groups;
  for (const FileColumn& column : columns) {
    const std::string group = column.path.substr(0, column.path.rfind('/'));
    if (!group.empty() && groups.insert(group).second) out.group(group);
    if (const auto* texts = std::get_if<std::vector<std::string>>(&column.values))
      out.texts(column.path, *texts);
    if (const auto* reals = std::get_if<std::vector<double>>(&column.values))
      out.array(column.path, *reals, column.width);
    if (const auto* wholes = std::get_if<std::vector<std::int64_t>>(&column.values))
      out.array(column.path, *wholes, column.width);
    if (const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&column.values))
      out.array(column.path, *bytes, column.width);
  }
  for (const FileAttribute& attribute : attributes) out.attribute("/", attribute.name, attribute.value);
  write_text_atomically(file, out.bytes());
}

}  // namespace remodel::io
