# Writes PAGE, the source that holds FOLDER/page.html with SCRIPT in it; without SCRIPT, it holds nothing.
set(text "")
if(SCRIPT)
  file(READ ${FOLDER}/page.html text)
  file(READ ${FOLDER}/three.txt license)
  file(READ ${SCRIPT} script)
  string(REPLACE "[[license]]" "${license}" text "${text}")
  string(REPLACE "[[script]]" "${script}" text "${text}")
endif()
file(WRITE ${PAGE} "#include \"html/page.h\"

std::string_view selvedge::app::html_page()
{
  return R\"selvedge(${text})selvedge\";
}
")
