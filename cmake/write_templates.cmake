# cmake -DOUTPUT= -DFILES="a;b" -P write_templates.cmake
# Writes a source file that holds scenarios as texts.
set(source "#include \"cli/new_scenario.hpp\"\n\nnamespace dualdamp::cli {\n\nconst std::vector<std::string_view>& templates() {\n  static const std::vector<std::string_view> list = {\n")
foreach(file IN LISTS FILES)
  file(READ ${file} text)
  # Brackets and semicolons of the text would be taken for a list's: only the whole is appended, never split.
  string(APPEND source "R\"yaml~(${text})yaml~\",\n")
endforeach()
string(APPEND source "  };\n  return list;\n}\n\n}  // namespace dualdamp::cli\n")
file(WRITE ${OUTPUT} "${source}")
