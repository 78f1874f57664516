#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# apt_fetch.sh source PACKAGE FOLDER [PART...]  downloads the sources from which the distribution built the installed package
#                                               PACKAGE into FOLDER, without the distribution's patches. The file `package` there
#                                               has the name and the version. With parts, which are files and folders, only these
#                                               are unpacked
# apt_fetch.sh files SUITE PACKAGE FOLDER       unpacks the files of a package of another suite of Debian, such as trixie, into
#                                               FOLDER. Nothing is installed
# apt checks the signature of the distribution. Neither command needs root rights.
set -euo pipefail

# begin FOLDER: makes the folders that apt works in. Sets the options by which apt uses them and the sources in FOLDER/parts.
begin() {
  rm -rf "$1"
  mkdir -p "$1/lists/partial" "$1/parts" "$1/archives/partial"
  options=(-q -o "Dir::Etc::SourceList=/dev/null" -o "Dir::Etc::SourceParts=$1/parts" -o "Dir::State::Lists=$1/lists"
    -o "Dir::Cache=$1" -o APT::Sandbox::User=root)
}

fetch_source() {
  local folder package file parts=()
  folder=$(realpath -m -- "$2")
  package=$(dpkg-query -W -f='${source:Package}=${source:Version}' "$1")
  rm -rf "$folder"
  begin "$folder.part"
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
    [[ ! -r $file ]] ||
      sed -n 's/^deb\(-src\)\? /deb-src /p' "$file" | sort -u >"$folder.part/parts/$(basename "$file" .list).list"
  done
  for file in /etc/apt/sources.list.d/*.sources; do
    [[ ! -r $file ]] || sed 's/^Types:.*/Types: deb-src/' "$file" >"$folder.part/parts/$(basename "$file")"
  done
  # Sources other than the distribution's may have no source packages. The next commands find out whether a source has this one.
  apt-get "${options[@]}" update || true
  (cd "$folder.part" && apt-get "${options[@]}" --download-only --tar-only source "$package")
  for file in "${@:3}"; do parts+=("*/$file"); done
  mkdir "$folder"
  echo "$package" >"$folder/package"
  tar -xf "$folder.part"/*.orig.tar.* --strip-components 1 -C "$folder" ${parts[@]+--wildcards "${parts[@]}"}
  rm -rf "$folder.part"
}

fetch_files() {
  local suite=$1 package=$2 folder mirror keyring=/usr/share/keyrings/debian-archive-keyring.gpg own
  folder=$(realpath -m -- "$3")
  rm -rf "$folder"
  begin "$folder.part"
  # A root of in_root.sh has the keyring of its host.
  own=$(find /etc/apt/keyrings -name 'host-*' 2>/dev/null | head -n 1)
  # shellcheck disable=SC2016 # apt's variables
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' 'Component: main' | grep -v security | head -n 1)
  echo "deb [signed-by=${own:-$keyring}] $mirror $suite main" >"$folder.part/parts/$suite.list"
  apt-get "${options[@]}" update
  (cd "$folder.part" && apt-get "${options[@]}" download "$package" && dpkg-deb -x "$package"_*.deb "$folder")
  rm -rf "$folder.part"
}

case ${1:-}/$# in
  source/[3-9]) fetch_source "${@:2}" ;;
  files/4) fetch_files "${@:2}" ;;
  *)
    echo "usage: packaging/apt_fetch.sh source PACKAGE FOLDER [PART...], or packaging/apt_fetch.sh files SUITE PACKAGE FOLDER" >&2
    exit 2
    ;;
esac
