// The websocket: says hello, connects again when it is lost, and keeps nothing back.

import { FromPage, FromServer, VERSION } from "./protocol";

export class Connection {
  private socket: WebSocket | null = null;
  private wait = 250;

  /**
   * @param page The page's own name, the same after a reload.
   * @param person Gives the person's name.
   * @param hear Is given every message.
   * @param changed Is told when the connection comes or goes.
   */
  constructor(
    private readonly page: string,
    private readonly person: () => string,
    private readonly hear: (message: FromServer) => void,
    private readonly changed: (open: boolean, words: string) => void,
  ) {
    this.connect();
  }

  get open(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** Send a message; false if there is no connection. */
  send(message: FromPage): boolean {
    if (!this.open) return false;
    this.socket!.send(JSON.stringify(message));
    return true;
  }

  hello(): void {
    this.send({ what: "hello", version: VERSION, page: this.page, name: this.person() });
  }

  private connect(): void {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/socket`);
    this.socket = socket;
    socket.onopen = () => {
      this.wait = 250;
      this.hello();
      this.changed(true, "connected");
    };
    socket.onmessage = (event) => this.hear(JSON.parse(event.data as string) as FromServer);
    socket.onclose = (event) => {
      if (this.socket !== socket) return;
      this.changed(false, event.reason || "connecting again…");
      window.setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(2 * this.wait, 4000);
    };
  }
}
