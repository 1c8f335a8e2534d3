# The manual page and the completions, which the program writes itself, and the Debian package that cpack makes: scripts/package.
set(pages ${PROJECT_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages})
set(written)
foreach(call IN ITEMS "manual" "completion bash" "completion zsh" "completion fish")
  string(REPLACE " " "." name ${call})
  separate_arguments(words UNIX_COMMAND ${call})
  add_custom_command(OUTPUT ${pages}/${name} COMMAND dualdamp ${words} > ${pages}/${name} DEPENDS dualdamp VERBATIM)
  list(APPEND written ${pages}/${name})
endforeach()
add_custom_command(OUTPUT ${pages}/dualdamp.1.gz COMMAND gzip -9nc ${pages}/manual > ${pages}/dualdamp.1.gz DEPENDS ${pages}/manual VERBATIM)
add_custom_target(dualdamp_pages ALL DEPENDS ${written} ${pages}/dualdamp.1.gz)

# The maintainer of the Debian package, as Debian's tools are told.
set(CPACK_PACKAGE_CONTACT "dualdamp contributors <root@localhost>")
if(DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "dualdamp contributors <$ENV{DEBEMAIL}>")
  if(DEFINED ENV{DEBFULLNAME})
    set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
  endif()
endif()
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  # What Debian wants of a package.
  set(zsh_place ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${pages}/changelog.Debian
    "dualdamp (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n  * What changed is in changelog.gz.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
  execute_process(COMMAND gzip -9nc ${pages}/changelog.Debian OUTPUT_FILE ${pages}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md OUTPUT_FILE ${pages}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/package/copyright ${pages}/changelog.Debian.gz ${pages}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/dualdamp)
else()
  set(zsh_place ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
endif()
install(FILES ${pages}/dualdamp.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${pages}/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME dualdamp)
install(FILES ${pages}/completion.zsh DESTINATION ${zsh_place} RENAME _dualdamp)
install(FILES ${pages}/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME dualdamp.fish)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dualdamp)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulate vibrations with friction and identify friction from them")
set(CPACK_PACKAGE_DESCRIPTION "A mass on a spring with friction, simulated exactly from event to event;
viscous damping and Coulomb friction identified from measured amplitudes,
decays and histories; and a test of how far such estimates can be trusted
when friction is not what they assume.

The package holds the program, its static libraries with their headers, and
the C header for friction laws of one's own.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
# What a program of one's own needs to link the libraries.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libboost-dev, libceres-dev, libeigen3-dev, libfmt-dev, libmatio-dev, libsleef-dev, libssl-dev, libtbb-dev, libudunits2-dev, libyaml-cpp-dev, nlohmann-json3-dev")
include(CPack)
