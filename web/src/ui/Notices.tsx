// Short messages at the lower edge.
import { X } from "lucide-preact";
import { useApp, useSelect } from "./app_context";
import { IconButton } from "./IconButton";

export function Notices() {
    const { store } = useApp();
    const notices = useSelect((state) => state.page.notices);
    return (
        <div class="notices" aria-live="polite">
            {notices.map((notice) => (
                <div key={notice.id} class={`notice notice-${notice.tone}`} role={notice.tone === "error" ? "alert" : "status"}>
                    <span>{notice.text}</span>
                    <IconButton icon={X} class="small" label="Dismiss" onClick={() => store.dispatch({ type: "page/noticeGone", id: notice.id })} />
                </div>
            ))}
        </div>
    );
}
