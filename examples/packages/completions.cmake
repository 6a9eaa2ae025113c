# Writes the scripts by which bash, zsh and fish complete oriel, made by oriel itself, to where the shells look for them.
list(GET PROGRAMS 0 program)
# Debian's zsh looks there for what packages bring, and beside it for what others install.
set(zsh_folder site-functions)
if(CMAKE_INSTALL_PREFIX MATCHES "/usr$")
  set(zsh_folder vendor-completions)
endif()
set(bash_file bash-completion/completions/oriel)
set(zsh_file zsh/${zsh_folder}/_oriel)
set(fish_file fish/vendor_completions.d/oriel.fish)
foreach(shell bash zsh fish)
  execute_process(COMMAND ${program} completion ${shell} OUTPUT_VARIABLE script COMMAND_ERROR_IS_FATAL ANY)
  # Bytes as they are: a script may hold semicolons and brackets.
  file(WRITE ${TO}/share/${${shell}_file} "${script}")
  message(STATUS "Installing: ${TO}/share/${${shell}_file}")
endforeach()
