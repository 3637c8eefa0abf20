import { useEffect, useRef, useState } from 'react';
import type { Alert } from '../api';
import { keep, kept } from '../kept';

const kKept = 'trailcast-notices';
const ways = { silent: 'nothing but its line', sound: 'a sound', both: 'a sound and a notification' };
type Way = keyof typeof ways;

const kTones_hz = [880, 660];
const kTone_s = 0.18;
const kLoudness = 0.2;

function play(audio: AudioContext) {
  const level = audio.createGain();
  level.gain.value = kLoudness;
  level.connect(audio.destination);
  kTones_hz.forEach((tone_hz, i) => {
    const tone = audio.createOscillator();
    tone.frequency.value = tone_hz;
    tone.connect(level);
    tone.start(audio.currentTime + i * kTone_s);
    tone.stop(audio.currentTime + (i + 1) * kTone_s);
    if (i + 1 === kTones_hz.length) tone.onended = () => void audio.close();
  });
}

// Two falling tones.
function sound() {
  try {
    play(new AudioContext());
  } catch {
    // There are no loudspeakers, or a browser plays nothing before a person has pressed something on the page.
  }
}

const mayNotify = () => 'Notification' in window && Notification.permission === 'granted';

function notify(title: string, body: string, hash: string) {
  if (!mayNotify() || (document.hasFocus() && !document.hidden)) return;
  try {
    const notice = new Notification(title, { body, tag: hash });
    notice.onclick = () => {
      window.focus();
      window.location.hash = hash;
      notice.close();
    };
  } catch {
    // Browsers of phones let only service workers notify.
  }
}

// Calls for a person when an alert is new, and when the connection is lost, as chosen in this browser. What is there
// when the page opens is seen anyway.
export function useNotices(alerts: Alert[], settled: boolean, lost: boolean) {
  const known = useRef<Set<string> | null>(null);
  const wasLost = useRef(lost);
  useEffect(() => {
    if (!settled) return;
    const fresh = known.current ? alerts.filter((alert) => !known.current!.has(alert.alert)) : [];
    known.current = new Set(alerts.map((alert) => alert.alert));
    const losing = lost && !wasLost.current;
    wasLost.current = lost;
    const way = kept(kKept, ways, 'silent');
    if (way === 'silent' || (fresh.length === 0 && !losing)) return;
    sound();
    if (way !== 'both') return;
    for (const alert of fresh) notify(`${alert.robot ?? alert.server}: ${alert.reason}`, alert.action, alert.robot ? `fleet/${alert.robot}` : 'history/alerts');
    if (losing) notify('Connection lost', 'Stop will not reach robots.', 'fleet');
  }, [alerts, settled, lost]);
}

export function NoticeChoice() {
  const [way, setWay] = useState<Way>(() => kept(kKept, ways, 'silent'));
  const [refused, setRefused] = useState(false);
  const choose = async (next: Way) => {
    keep(kKept, next);
    setWay(next);
    if (next !== 'silent') sound();
    if (next === 'both' && 'Notification' in window) await Notification.requestPermission();
    setRefused(next === 'both' && !mayNotify());
  };
  return (
    <p>
      <label>
        A new alert comes with{' '}
        <select value={way} onChange={({ target }) => void choose(target.value as Way)}>
          {Object.entries(ways).map(([name, label]) => <option key={name} value={name}>{label}</option>)}
        </select>
      </label>
      {refused && ' This browser does not allow notifications: allow them for this page, which has to come by https or from this machine.'}
    </p>
  );
}
