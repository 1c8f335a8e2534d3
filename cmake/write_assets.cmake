# cmake -DOUTPUT= -DFILES="a;b" -DVIEWS="c;d" -P write_assets.cmake
# Writes a source file that holds the files as texts; the name of a text is that of the file, '.' as '_'. The views are one
# text, views_of_analyses_js.
set(source "#include \"cli/report/assets.hpp\"\n\nnamespace dualdamp::cli::assets {\n\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${file} text)
  # Brackets and semicolons of the text would be taken for a list's: only the whole is appended, never split.
  string(APPEND source "const std::string_view ${name} = R\"asset~(${text})asset~\";\n\n")
endforeach()
string(APPEND source "const std::string_view views_of_analyses_js = R\"asset~(")
foreach(file IN LISTS VIEWS)
  file(READ ${file} text)
  string(APPEND source "${text}\n")
endforeach()
string(APPEND source ")asset~\";\n\n")
string(APPEND source "}  // namespace dualdamp::cli::assets\n")
file(WRITE ${OUTPUT} "${source}")
