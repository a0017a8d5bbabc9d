// An admin's page: who may log in, as what, and who is logged in.

import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { problemOf } from "./conditions";
import { useEscape } from "./escape";
import { Sure } from "./sure";
import { t, Word } from "./words";

type User = { name: string; role: string; sessions: number };
type Change = (path: string, method: string, body?: object) => Promise<boolean>;
const ROLES = ["viewer", "operator", "admin"] as const;

async function ask(path: string, method: string, body?: object): Promise<any> {
  const response = await fetch(path, { method, headers: { "Content-Type": "application/json" }, body: body && JSON.stringify(body) }).catch(() => null);
  if (!response) return { error: t("link_lost") };
  return response.json().catch(() => ({ error: response.statusText }));
}

// The users as the server knows them, and what it said last of a change.
function useUsers() {
  const [users, setUsers] = useState<User[]>([]);
  const [said, setSaid] = useState("");
  const look = async () => {
    const answer = await ask("/api/users", "GET");
    setUsers(answer.users ?? []);
    if (answer.error) setSaid(problemOf(answer));
  };
  // True when it was done.
  const change: Change = async (path, method, body) => {
    const answer = await ask(path, method, body);
    setSaid(problemOf(answer) || t("done"));
    await look();
    return !answer.error;
  };
  return { users, said, look, change };
}

function UserRow({ user, isSelf, change }: { user: User; isSelf: boolean; change: Change }) {
  return (
    <tr>
      <td>{user.name}</td>
      <td>{t(`r_${user.role}` as Word)}</td>
      <td>{user.sessions}</td>
      <td>
        <button type="button" disabled={user.sessions === 0} onClick={() => change(`/api/sessions/${user.name}`, "DELETE")} aria-label={`${t("end_sessions")}: ${user.name}`}>
          {t("end_sessions")}
        </button>
        {!isSelf && (
          <Sure
            word={t("remove")}
            label={`${t("remove")}: ${user.name}`}
            question={`${user.name}: ${t("remove_sure")}`}
            onSure={() => change(`/api/users/${user.name}`, "DELETE")}
          />
        )}
      </td>
    </tr>
  );
}

// A user of a known name gets the new role and password.
function EnterUser({ change }: { change: Change }) {
  const enter = async (event: Event) => {
    event.preventDefault();
    const form = event.currentTarget as HTMLFormElement;
    const given = Object.fromEntries(new FormData(form));
    if (await change("/api/users", "POST", given)) form.reset();
  };
  return (
    <form onSubmit={enter}>
      <label>
        {t("name")}
        <input name="name" required maxLength={40} autocomplete="off" />
      </label>
      <label>
        {t("role")}
        <select name="role">
          {ROLES.map((role) => (
            <option value={role}>{t(`r_${role}`)}</option>
          ))}
        </select>
      </label>
      <label>
        {t("password")}
        <input name="password" type="password" required minLength={8} autocomplete="new-password" />
      </label>
      <button>{t("enter_user")}</button>
    </form>
  );
}

export function Users({ self, onClose }: { self: string; onClose: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const { users, said, look, change } = useUsers();
  useEscape(true, onClose);
  useEffect(() => {
    dialog.current!.show();
    void look();
  }, []);
  return (
    <dialog ref={dialog} class="users" aria-label={t("users")} onClose={onClose}>
      <div class="users-head">
        <h2>{t("users")}</h2>
        <button type="button" onClick={() => dialog.current!.close()}>
          {t("close")}
        </button>
      </div>
      <div class="scroll">
        <table>
          <thead>
            <tr>
              <th>{t("name")}</th>
              <th>{t("role")}</th>
              <th>{t("logged_in")}</th>
              <th>{t("what")}</th>
            </tr>
          </thead>
          <tbody>
            {users.map((user) => (
              <UserRow key={user.name} user={user} isSelf={user.name === self} change={change} />
            ))}
          </tbody>
        </table>
      </div>
      <EnterUser change={change} />
      <p class="users-hint">{t("users_hint")}</p>
      <p role="status">{said}</p>
    </dialog>
  );
}
