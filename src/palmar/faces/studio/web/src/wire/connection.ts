/**
 * The WebSocket to the server. On every channel the newest request wins: one is out, the newest of those behind it waits,
 * and answers to older ones are dropped. A lost connection is made again, and what was asked last is asked again.
 */

import type { CaseFile } from "../case/case_file";
import type { Hello } from "./hello";

export interface Part {
  readonly part: string;
  readonly stage: "quick" | "settled";
  readonly guarantee: string | null;
  readonly last: boolean;
  readonly ms: number;
  readonly value: unknown;
  readonly seq: number;
}

export interface Request {
  readonly kind: string;
  readonly channel?: string;
  readonly file?: CaseFile | string;
  readonly parameters?: Readonly<Record<string, unknown>>;
  /** `enough`: whether the next request may go out now. */
  readonly onPart: (part: Part, enough: boolean) => void;
  /** The end, unless a newer request is about to follow: null, or what was wrong. */
  readonly onEnd: (error: string | null) => void;
  /** Whether after this part the next request may go out; without it after the last one. */
  readonly enough?: (part: Part) => boolean;
}

export type Status = "connecting" | "ready" | "lost";

interface Channel {
  out: { readonly request: Request; readonly seq: number } | null;
  /** Whether what is out has answered so far that a newer request may follow. */
  free: boolean;
  waiting: Request | null;
  patience: number | undefined;
}

interface Frame extends Partial<Part> {
  readonly kind?: string | null;
  readonly channel?: string;
  readonly error?: string;
}

/** A request that has not answered for so long (ms) is overtaken: the server stops it when a newer one comes. */
const PATIENCE = 120;
const RETRY_FIRST = 250;
const RETRY_LAST = 4000;

export class Connection {
  private socket: WebSocket | null = null;
  private readonly channels = new Map<string, Channel>();
  private readonly listeners = new Set<() => void>();
  private seq = 0;
  private retry = RETRY_FIRST;
  status: Status = "connecting";
  hello: Hello | null = null;

  constructor(private readonly address: string) {
    this.open();
  }

  /** Calls back on every change of `status` and `hello`; returns how to stop that. */
  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  };

  /** Put a question; it replaces the one that waits on the same channel. */
  ask(request: Request): void {
    const channel = this.channel(key(request.kind, request.channel));
    channel.waiting = request;
    this.pump(channel);
  }

  /** Whether a question would go out at once. */
  isIdle(kind: string): boolean {
    return this.channel(key(kind)).free && this.status === "ready";
  }

  private channel(name: string): Channel {
    let found = this.channels.get(name);
    if (!found) this.channels.set(name, (found = { out: null, free: true, waiting: null, patience: undefined }));
    return found;
  }

  private pump(channel: Channel): void {
    const request = channel.waiting;
    if (!request || !channel.free || this.status !== "ready" || !this.socket) return;
    channel.waiting = null;
    channel.free = false;
    window.clearTimeout(channel.patience);
    channel.patience = window.setTimeout(() => {
      channel.free = true;
      this.pump(channel);
    }, PATIENCE);
    this.seq += 1;
    channel.out = { request, seq: this.seq };
    const { kind, channel: name = "", file, parameters = {} } = request;
    const frame = { id: `${kind}${this.seq}`, seq: this.seq, kind, channel: name, parameters };
    this.socket.send(JSON.stringify(file === undefined ? frame : { ...frame, case: file }));
  }

  private open(): void {
    const socket = new WebSocket(this.address);
    this.socket = socket;
    socket.onmessage = (event) => this.receive(JSON.parse(String(event.data)) as Frame);
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      for (const channel of this.channels.values()) {
        if (channel.out && !channel.waiting) channel.waiting = channel.out.request;
        channel.out = null;
        channel.free = true;
      }
      this.become("lost");
      window.setTimeout(() => this.open(), this.retry);
      this.retry = Math.min(2 * this.retry, RETRY_LAST);
    };
  }

  private receive(frame: Frame): void {
    if (frame.kind === "hello") {
      this.hello = frame as unknown as Hello;
      this.retry = RETRY_FIRST;
      this.become("ready");
      for (const channel of this.channels.values()) this.pump(channel);
      return;
    }
    const channel = this.channels.get(key(frame.kind ?? "", frame.channel));
    const out = channel?.out;
    if (!channel || !out || out.seq !== frame.seq) return;
    if (frame.error === undefined && frame.part !== "end") {
      const part = frame as Part;
      const enough = out.request.enough?.(part) ?? false;
      out.request.onPart(part, enough);
      if (enough) channel.free = true;
    }
    if (frame.last) {
      channel.out = null;
      channel.free = true;
      if (!channel.waiting) out.request.onEnd(frame.error ?? null);
    }
    this.pump(channel);
  }

  private become(status: Status): void {
    this.status = status;
    for (const each of this.listeners) each();
  }
}

const key = (kind: string, channel = ""): string => `${kind}/${channel}`;

/** The address of the server that the page came from. */
export const serverAddress = (): string => `${location.origin.replace(/^http/, "ws")}/ws`;
