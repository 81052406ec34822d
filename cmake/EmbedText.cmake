# cmake -DSOURCE=page.js -DTARGET=page_js.cpp -DNAME=page_js -P EmbedText.cmake: a text file as a constant of
# the namespace floe, so that the program carries it along.
file(READ "${SOURCE}" text)
get_filename_component(file "${SOURCE}" NAME)
file(WRITE "${TARGET}" "// Made from ${file} by cmake/EmbedText.cmake.
#include <string_view>
namespace floe {
extern const std::string_view ${NAME};
const std::string_view ${NAME} = R\"~text~(${text})~text~\";
}
")
