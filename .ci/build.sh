# Configures and builds; sourced by the scripts that need a built project, from its top folder.

# build_project SETTINGS FOLDER [TARGET...]: SETTINGS names a file of .cmake/; without targets,
# everything is built. A folder that is configured already is only brought up to date.
build_project()
{
  local settings=.cmake/$1.cmake folder=$2 targets=("${@:3}")
  if [[ ! -f $folder/build.ninja ]]; then
    cmake -C "$settings" -S . -B "$folder" || return 1
  fi
  cmake --build "$folder" ${targets[@]+--target "${targets[@]}"}
}
