# What CPack is told of the packages: names, dependencies and descriptions.
set(ORIEL_MAINTAINER "The oriel authors <maintainers@oriel.invalid>" CACHE STRING "Who makes the packages: name and address")

# When this version was made, in changelogs and man pages: no clock, so that the same sources give the same text.
set(ORIEL_DATE "Thu, 26 Nov 2026 00:00:00 +0000")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME oriel)
set(CPACK_PACKAGE_VENDOR "The oriel authors")
set(CPACK_PACKAGE_CONTACT "${ORIEL_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
# The descriptions below are whole: no summary is put before them.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
# Folders that a script makes have the rights that Debian wants.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_COMPONENTS_ALL oriel dev doc)
if(ORIEL_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_ORIEL_PACKAGE_NAME oriel)
set(CPACK_DEBIAN_ORIEL_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ORIEL_PACKAGE_SHLIBDEPS ON)
# Opened when a picture is drawn.
set(CPACK_DEBIAN_ORIEL_PACKAGE_RECOMMENDS "libcairo2, fonts-dejavu-core")
set(CPACK_DEBIAN_ORIEL_PACKAGE_SUGGESTS "oriel-doc, liboriel-dev")
set(CPACK_DEBIAN_ORIEL_DESCRIPTION "find and name the parts of 3D buildings, redraw them for a scale
oriel cuts closed 3D buildings into their parts, names them by rules that
users write (window, door, chimney, dormer, balcony), says why each part has
its name, and redraws buildings for a map scale or a level of detail as valid
solids.
.
It reads CityJSON, CityJSONSeq, CityGML, OBJ, OFF, PLY and STL, writes these,
GeoPackages, GLB and 3D Tiles, and works through whole cities in bounded
memory.
.
This package has the commands oriel and oriel-generate, rule packs, completion
for bash, zsh and fish, and sample buildings in /usr/share/oriel/samples.")

# The packages whose headers the installed headers include, or whose libraries the static libraries need.
set(CPACK_DEBIAN_DEV_PACKAGE_NAME liboriel-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
       libboost-dev libcgal-dev libexpat1-dev libproj-dev libfmt-dev libgmp-dev libmeshoptimizer-dev libmpfr-dev libnlopt-cxx-dev libopenmesh-dev
       libpolyclipping-dev libsimdjson-dev libspdlog-dev libsqlite3-dev libyaml-cpp-dev nettle-dev nlohmann-json3-dev zlib1g-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "oriel-doc")
set(CPACK_DEBIAN_DEV_DESCRIPTION "library to label and generalise 3D buildings (development files)
oriel cuts closed 3D buildings into their parts, names them by rules and
redraws them for a map scale. The library does all that the command oriel
does, and writes the same bytes.
.
This package has headers, static libraries, the files for CMake's
find_package(oriel) and a small program that uses them.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME oriel-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "documentation of oriel, which names the parts of 3D buildings
oriel cuts closed 3D buildings into their parts, names them by rules and
redraws them for a map scale.
.
This package has its pages in Markdown: the commands, the language of rules,
formats, error codes, the stages one by one, and how well they do on real data.")

# Built for one version of the interpreter, as its file says.
if(ORIEL_PYTHON)
  math(EXPR next_python "${ORIEL_PYTHON_MINOR} + 1")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-oriel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${ORIEL_PYTHON_MINOR}~), python3 (<< 3.${next_python}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "libcairo2, fonts-dejavu-core")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "oriel-doc, python3-matplotlib, python3-pandas")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "find and name the parts of 3D buildings from Python
oriel cuts closed 3D buildings into their parts, names them by rules and
redraws them for a map scale.
.
This package has the module oriel for Python 3: it reads, labels, explains,
scores, redraws and writes buildings as the command oriel does, and gives the
attributes of their parts as NumPy arrays.")
