// The form of whoever logs in.

import { h } from "preact";
import { useState } from "preact/hooks";
import { type Look, LookChoice } from "./bar";
import { type HttpAnswer, problemOf } from "./conditions";
import type { Session } from "./link";
import { t } from "./words";

export function LogIn({ look, onSession }: { look: Look; onSession: (session: Session) => void }) {
  const [problem, setProblem] = useState<HttpAnswer | null>({}); // null: no answer
  const submit = async (event: Event) => {
    event.preventDefault();
    const form = new FormData(event.currentTarget as HTMLFormElement);
    const response = await fetch("/api/session", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ name: form.get("name"), password: form.get("password") }),
    }).catch(() => null);
    if (!response) return setProblem(null);
    const said = await response.json();
    if (response.ok) onSession({ open: false, ...said });
    else setProblem(said);
  };
  return (
    <main class="log-in">
      <form onSubmit={submit}>
        <h1>{t("title")}</h1>
        <label>
          {t("name")}
          <input name="name" autocomplete="username" required autofocus />
        </label>
        <label>
          {t("password")}
          <input name="password" type="password" autocomplete="current-password" required />
        </label>
        <button class="primary">{t("log_in")}</button>
        <p role="alert">{problem ? problemOf(problem) : t("link_lost")}</p>
        <div class="settings">
          <LookChoice {...look} />
        </div>
      </form>
    </main>
  );
}
