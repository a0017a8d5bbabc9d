#!/usr/bin/env bash
# What the time of an RTSP camera's pictures is wrong by, how old they are and what they cost a core, in a network
# namespace of its own.
#   rtsp_stamps.sh FOLDER_OF_PROGRAMS [OPTION...]    options of ols-bench-rtsp, such as --seconds 60
set -euo pipefail
bench=$1/ols-bench-rtsp
shift
ip link set lo up
"$bench" --port 8554 >/dev/null &
server=$!
trap 'kill $server; wait' EXIT
until (: </dev/tcp/127.0.0.1/8554) 2>/dev/null; do read -rt 0.1 <> <(:) || true; done
"$bench" --url rtsp://127.0.0.1:8554/video "$@"
