# Libraries from Debian's packages, each as a target that carries only the modules used.

find_package(Threads REQUIRED)
find_package(CURL REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto SSL)
find_package(TBB REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(pugixml REQUIRED)
find_package(prometheus-cpp REQUIRED COMPONENTS pull)
find_package(ICU REQUIRED COMPONENTS uc i18n data)
find_package(LibArchive REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(DCMTK REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FRIBIDI REQUIRED IMPORTED_TARGET fribidi)
pkg_check_modules(LIBPQ REQUIRED IMPORTED_TARGET libpq)
pkg_check_modules(HARFBUZZ REQUIRED IMPORTED_TARGET harfbuzz)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)

# Debian's SOCI and libharu come without CMake or pkg-config files.
find_path(SOCI_INCLUDE_DIR soci/soci.h REQUIRED)
add_library(vicon_soci INTERFACE)
target_include_directories(vicon_soci SYSTEM INTERFACE ${SOCI_INCLUDE_DIR} ${SOCI_INCLUDE_DIR}/soci)
target_link_libraries(vicon_soci INTERFACE soci_core soci_sqlite3 soci_postgresql sqlite3 PkgConfig::LIBPQ)

find_path(HPDF_INCLUDE_DIR hpdf.h REQUIRED)
add_library(vicon_hpdf INTERFACE)
target_include_directories(vicon_hpdf SYSTEM INTERFACE ${HPDF_INCLUDE_DIR})
target_link_libraries(vicon_hpdf INTERFACE hpdf)

add_library(vicon_dcmtk INTERFACE)
target_include_directories(vicon_dcmtk SYSTEM INTERFACE ${DCMTK_INCLUDE_DIRS})
# Not its JPEG-LS: its CharLS has the names of that which GDCM decodes with, and in one process calls would go astray.
target_link_libraries(vicon_dcmtk INTERFACE dcmnet dcmsr dcmjpeg dcmimage dcmimgle dcmdata dcmtls oflog ofstd)
# DCMTK's writer of segmentations.
add_library(vicon_dcmseg INTERFACE)
target_link_libraries(vicon_dcmseg INTERFACE dcmseg dcmfg dcmiod vicon_dcmtk)

# ITK: find_package() sets global variables for the modules asked for, so each set of modules is asked for in a scope of
# its own and kept as a target.
function(vicon_itk NAME)
  find_package(ITK 5 REQUIRED COMPONENTS ${ARGN} QUIET)
  add_library(${NAME} INTERFACE)
  target_include_directories(${NAME} SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
  target_link_libraries(${NAME} INTERFACE ${ITK_LIBRARIES})
  if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    target_compile_options(${NAME} INTERFACE "SHELL:-include ${PROJECT_SOURCE_DIR}/cmake/itk_with_clang.h")
  endif()
  set_target_properties(${NAME} PROPERTIES VICON_MODULES "${ARGN}")
endfunction()
vicon_itk(vicon_itk_io ITKIOMeta)
vicon_itk(vicon_itk_filters ITKCommon ITKImageFunction ITKImageGrid ITKMathematicalMorphology ITKRegionGrowing ITKThresholding)
if(VICON_BUILD_TESTS)
  vicon_itk(vicon_itk_masks ITKCommon ITKIOImageBase ITKIOMeta ITKIONIFTI ITKIONRRD)
  vicon_itk(vicon_itk_dicom ITKCommon ITKIOGDCM ITKIOImageBase)
  vicon_itk(vicon_itk_references ITKCommon ITKDistanceMap ITKFastMarching ITKImageFunction ITKImageGrid)
endif()
if(VICON_BUILD_BENCHMARKS)
  vicon_itk(vicon_itk_rivals ITKAnisotropicSmoothing ITKCommon ITKConnectedComponents ITKDistanceMap ITKFastMarching
            ITKImageFunction ITKImageGrid ITKMathematicalMorphology)
  vicon_itk(vicon_itk_chain ITKCommon ITKConnectedComponents ITKDistanceMap ITKFastMarching ITKImageGrid ITKIOGDCM
            ITKIOImageBase ITKThresholding)
endif()

find_package(VTK 9 REQUIRED COMPONENTS CommonCore CommonDataModel FiltersCore IOOggTheora IOXML RenderingCore
             RenderingFreeType RenderingOpenGL2)
if(VICON_BUILD_VIEWER)
  find_package(Qt5 REQUIRED COMPONENTS Core Gui Widgets Pdf PdfWidgets Test)
endif()
if(VICON_BUILD_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
if(VICON_BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
