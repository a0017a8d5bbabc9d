#!/usr/bin/env bash
# What the time of an RTSP camera's pictures is wrong by, how old they are and what they cost a core, in a network
# namespace of its own.
#   rtsp_stamps.sh FOLDER_OF_PROGRAMS [--relay MEDIAMTX [--replace-time]] [--cameras N] [OPTION...]
# --relay: through this mediamtx, a program or "published" or "corrected" of tools/build-mediamtx. It passes the camera's
# time on, or with --replace-time gives its own, as it does if nobody configures it.
# --cameras: so many, measured together. OPTION: of ols-bench-rtsp, such as --seconds 60.
set -euo pipefail
bench=$1/ols-bench-rtsp
shift
relay= keep=yes cameras=1 options=() served=()
while [ $# -gt 0 ]; do
  case $1 in
    --relay) relay=${2:?a program}; shift ;;
    --replace-time) keep=no ;;
    --cameras) cameras=${2:?a number}; shift ;;
    --width | --height | --rate) options+=("$1" "$2"); served+=("$1" "$2"); shift ;;
    *) options+=("$1") ;;
  esac
  shift
done
case $relay in published | corrected) relay=build/mediamtx/$relay ;; esac
[ -z "$relay" ] || [ -x "$relay" ] || { echo "--relay: there is no program $relay" >&2; exit 2; }

started=()
trap 'kill "${started[@]}" 2>/dev/null; wait' EXIT
# Until the program that was started last listens at this port.
answers() {
  until (: </dev/tcp/127.0.0.1/"$1") 2>/dev/null; do
    kill -0 "${started[-1]}" 2>/dev/null || { echo "nothing listens at port $1: its program has ended" >&2; exit 2; }
    read -rt 0.1 <> <(:) || true
  done
}

ip link set lo up
"$bench" --port 8600 --cameras "$cameras" "${served[@]}" >/dev/null &
started+=($!)
port=8600 urls=() paths=
for ((i = 0; i < cameras; ++i)); do
  answers $((port + i))
  urls+=(--url "rtsp://127.0.0.1:$((port + i))/video")
  paths+="
  camera$i: {source: 'rtsp://127.0.0.1:$((port + i))/video', rtspTransport: tcp, useAbsoluteTimestamp: $keep}"
done
if [ -n "$relay" ]; then
  settings=$(mktemp)
  printf '%s\n' "logLevel: error" "rtspAddress: 127.0.0.1:8554" "rtspTransports: [tcp]" "rtmp: no" "hls: no" \
    "webrtc: no" "srt: no" "paths:$paths" >"$settings"
  "$relay" "$settings" >&2 &
  started+=($!)
  answers 8554
  for ((i = 0; i < cameras; ++i)); do urls[2 * i + 1]=rtsp://127.0.0.1:8554/camera$i; done
fi
"$bench" "${urls[@]}" "${options[@]}"
