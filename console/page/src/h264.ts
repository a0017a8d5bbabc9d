// One station's H.264, decoded by the browser (WebCodecs). Each message has the access units that this
// browser has not had; only the picture of the newest is shown, under the header that came with it.

export type Unit = [utime_us: number, bytes: number, isKey: boolean];
type Shown<Header> = (header: Header, image: ImageBitmap) => void;

const MOST_WAITING = 60; // of a device that is slower than the video

// Whether this browser decodes it. WebCodecs exists only over TLS, or on the console's own computer.
export async function decodesH264(): Promise<boolean> {
  if (!("VideoDecoder" in window)) return false;
  const answer = await VideoDecoder.isConfigSupported({ codec: "avc1.42E028" }).catch(() => null);
  return answer?.supported ?? false;
}

// As the stream's own parameters have it: profile, constraints, level follow the type of the unit.
function codecOf(key: Uint8Array): string {
  const at = key.findIndex((byte, i) => byte === 1 && key[i - 1] === 0 && key[i - 2] === 0) + 2;
  return "avc1." + [...key.subarray(at, at + 3)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

export class H264Stream<Header extends { utime_us: number; units: Unit[] }> {
  private decoder: VideoDecoder | null = null;
  private codec = "";
  private waiting = new Map<number, Header>();
  private newest_us = 0;

  constructor(
    private show: Shown<Header>,
    private fail: () => void,
  ) {}

  take(header: Header, bytes: Uint8Array<ArrayBuffer>) {
    try {
      let at = 0;
      for (const [utime_us, length, isKey] of header.units) {
        this.decode(utime_us, isKey, bytes.subarray(at, at + length));
        at += length;
      }
      this.waiting.set(header.utime_us, header);
    } catch {
      this.fail();
    }
  }

  close() {
    if (this.decoder && this.decoder.state !== "closed") this.decoder.close();
    this.decoder = null;
  }

  private decode(utime_us: number, isKey: boolean, data: Uint8Array<ArrayBuffer>) {
    // What waits is not worth decoding any more: at the next key frame it begins again.
    if (this.decoder && this.decoder.decodeQueueSize > MOST_WAITING) this.close();
    if (isKey) this.open(codecOf(data));
    this.decoder?.decode(new EncodedVideoChunk({ type: isKey ? "key" : "delta", timestamp: utime_us, data }));
  }

  private open(codec: string) {
    if (this.decoder && this.codec === codec) return;
    this.close();
    this.waiting.clear();
    this.newest_us = 0;
    this.codec = codec;
    this.decoder = new VideoDecoder({ output: (frame) => void this.decoded(frame), error: () => this.fail() });
    this.decoder.configure({ codec, optimizeForLatency: true });
  }

  private async decoded(frame: VideoFrame) {
    const header = this.waiting.get(frame.timestamp);
    for (const utime_us of [...this.waiting.keys()]) if (utime_us <= frame.timestamp) this.waiting.delete(utime_us);
    const image = header ? await createImageBitmap(frame).catch(() => null) : null;
    frame.close();
    if (!image || !header) return;
    if (header.utime_us <= this.newest_us) return image.close();
    this.newest_us = header.utime_us;
    this.show(header, image);
  }
}
