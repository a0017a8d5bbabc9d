// The page: in its theme and language, the console of whoever is logged in, or the form to log in.

import { h, render } from "preact";
import { useEffect, useState } from "preact/hooks";
import "ol/ol.css";
import "./page.css";
import { Console } from "./console";
import type { Session } from "./link";
import { LogIn } from "./login";
import { remember, remembered } from "./memory";
import { Language, LANGUAGES, setLanguage } from "./words";

function Page() {
  const [session, setSession] = useState<Session | null | undefined>(undefined);
  const [theme, setTheme] = useState(remembered("theme", matchMedia("(prefers-color-scheme: light)").matches ? "day" : "night"));
  const [language, setTheLanguage] = useState<Language>(remembered("language", navigator.language.startsWith("de") ? "de" : "en") as Language);
  setLanguage(LANGUAGES.includes(language) ? language : "en");
  document.documentElement.dataset.theme = theme;
  useEffect(() => {
    void fetch("/api/session")
      .then((response) => (response.ok ? response.json() : null))
      .then(setSession)
      .catch(() => setSession(null));
  }, []);
  const logOut = async () => {
    await fetch("/api/session", { method: "DELETE" }).catch(() => null);
    setSession(null);
  };
  if (session === undefined) return null;
  const look = {
    theme,
    language,
    onTheme: (wanted: string) => {
      remember("theme", wanted);
      setTheme(wanted);
    },
    onLanguage: (wanted: Language) => {
      remember("language", wanted);
      setTheLanguage(wanted);
    },
  };
  if (session === null) return <LogIn look={look} onSession={setSession} />;
  return <Console session={session} look={look} onLoggedOut={logOut} />;
}

render(<Page />, document.getElementById("page")!);
